#include "surface/spatial/wide_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/parallel.hpp"
#include "surface/spatial/binned_ranges.hpp"

namespace curveskel {
namespace {

constexpr int largest_slab = 1024;  // triangles; larger pieces of a surface are no flat patches
constexpr int part_faces = 8192;    // at most, below the fans: enough for a thread's coming
constexpr std::size_t faces_at_once = 1 << 14;

/// Up to four ranges that one node tells apart.
struct Fan {
  std::array<Range, 4> ranges;
  int used = 1;
  std::array<int, 4> part{};  // near the root: another fan, or ~number of a part
};

/// A stretch of the tree: a node's children lie within it, or are leaves of it.
struct Stretch {
  std::vector<WideNode> nodes;
  std::vector<TriangleLeaf> leaves;  // with vertices of the surface
};

class Builder {
 public:
  Builder(const Surface& surface, WideTree& tree, int threads)
      : surface_(surface), tree_(tree), threads_(threads) {
    const auto faces = static_cast<std::size_t>(surface.triangles.rows());
    local_.resize(static_cast<std::size_t>(surface.positions.rows()));
    parallel_for(local_.size(), faces_at_once, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        local_[v] = tree.to_local(surface.positions.row(static_cast<Eigen::Index>(v)));
      }
    });
    ranges_.boxes.resize(faces);
    ranges_.order.resize(faces);
    parallel_for(faces, faces_at_once, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        ranges_.order[f] = static_cast<int>(f);
        ranges_.boxes[f] = box_of(static_cast<int>(f));
      }
    });
  }

  /// Fans near the root, then the parts below them beside one another, in the end all in the order
  /// in which one part alone would have been made.
  void build() {
    const Range whole = ranges_.measured(0, static_cast<int>(ranges_.order.size()), 0);
    if (whole.size() <= part_faces) {
      Stretch part;
      make_node(whole, part);
      tree_.nodes = std::move(part.nodes);
      tree_.leaves = std::move(part.leaves);
    } else {
      std::vector<Range> below;
      const std::vector<Fan> fans = fans_near_root(whole, below);
      std::vector<Stretch> parts(below.size());
      parallel_for(parts.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (below[i].size() > leaf_size) {
            make_node(below[i], parts[i]);
          } else {
            make_leaf(below[i], parts[i]);
          }
        }
      });
      ranges_.boxes = {};
      join(fans, parts);
    }
    place_vertices();
  }

 private:
  [[nodiscard]] const Eigen::Vector3d& corner(int face, int k) const {
    return local_[static_cast<std::size_t>(surface_.triangles(face, k))];
  }

  [[nodiscard]] Box box_of(int face) const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f p = corner(face, k).cast<float>();
      box.include(Float4{p.x(), p.y(), p.z(), 0});
    }
    const Float4 margin{box_margin, box_margin, box_margin, 0};
    box.lo -= margin;
    box.hi += margin;
    return box;
  }

  std::vector<Fan> fans_near_root(const Range& whole, std::vector<Range>& below) {
    std::vector<Fan> fans{{{whole}}};
    for (std::size_t first = 0; first < fans.size();) {
      const std::size_t end = fans.size();
      parallel_for(end - first, 1, threads_, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = first + from; i < first + to; ++i) spread(fans[i]);
      });
      for (; first < end; ++first) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(fans[first].used); ++i) {
          const Range range = fans[first].ranges[i];
          if (range.size() > part_faces) {
            fans[first].part[i] = static_cast<int>(fans.size());
            fans.push_back({{range}});
          } else {
            fans[first].part[i] = ~static_cast<int>(below.size());
            below.push_back(range);
          }
        }
      }
    }
    return fans;
  }

  void join(const std::vector<Fan>& fans, std::vector<Stretch>& parts) {
    std::size_t nodes = fans.size();
    std::size_t leaves = 0;
    for (const Stretch& part : parts) {
      nodes += part.nodes.size();
      leaves += part.leaves.size();
    }
    tree_.nodes.reserve(nodes);
    tree_.leaves.reserve(leaves);
    append(fans, 0, parts);
  }

  std::int32_t append(const std::vector<Fan>& fans, std::size_t number,
                      std::vector<Stretch>& parts) {
    const Fan& fan = fans[number];
    const auto index = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::array<std::int32_t, 4> child{-1, -1, -1, -1};
    for (std::size_t i = 0; i < static_cast<std::size_t>(fan.used); ++i) {
      const std::int32_t part = fan.part[i];
      child[i] = part >= 0 ? append(fans, static_cast<std::size_t>(part), parts)
                           : append(parts[static_cast<std::size_t>(-(part + 1))]);
    }
    set_children(tree_.nodes[static_cast<std::size_t>(index)], fan, child);
    return index;
  }

  std::int32_t append(Stretch& part) {
    const auto nodes = static_cast<std::int32_t>(tree_.nodes.size());
    const auto leaves = static_cast<std::int32_t>(tree_.leaves.size());
    tree_.leaves.insert(tree_.leaves.end(), part.leaves.begin(), part.leaves.end());
    for (WideNode& node : part.nodes) {
      for (std::int32_t& child : node.child) child += child < 0 ? -leaves : nodes;
      tree_.nodes.push_back(node);
    }
    const bool leaf_alone = part.nodes.empty();
    part = {};
    return leaf_alone ? ~leaves : nodes;
  }

  void spread(Fan& fan) {
    while (fan.used < 4) {
      int widest = -1;
      float area = -1;
      for (int i = 0; i < fan.used; ++i) {
        const Range& range = fan.ranges[static_cast<std::size_t>(i)];
        if (range.size() > leaf_size && range.box.half_area() > area) {
          area = range.box.half_area();
          widest = i;
        }
      }
      if (widest < 0) break;
      auto& range = fan.ranges[static_cast<std::size_t>(widest)];
      std::tie(range, fan.ranges[static_cast<std::size_t>(fan.used++)]) = ranges_.split(range);
    }
  }

  std::int32_t make_node(const Range& whole, Stretch& part) {
    Fan fan{{whole}};
    spread(fan);
    const auto index = static_cast<std::int32_t>(part.nodes.size());
    part.nodes.emplace_back();
    std::array<std::int32_t, 4> child{-1, -1, -1, -1};
    for (std::size_t i = 0; i < static_cast<std::size_t>(fan.used); ++i) {
      const Range& range = fan.ranges[i];
      child[i] = range.size() > leaf_size ? make_node(range, part) : ~make_leaf(range, part);
    }
    set_children(part.nodes[static_cast<std::size_t>(index)], fan, child);
    return index;
  }

  void set_children(WideNode& node, const Fan& fan,
                    const std::array<std::int32_t, 4>& child) const {
    node.child = child;
    for (int i = 0; i < 4; ++i) {
      const bool in_use = i < fan.used;
      const Range& range = fan.ranges[static_cast<std::size_t>(i)];
      set_bounds(node, i, in_use ? range.box : Box{}, in_use ? slab_of(range) : Slab{});
    }
  }

  struct Slab {
    Eigen::Vector3f normal{0, 0, 0};
    float lo = -huge;
    float hi = huge;
  };

  [[nodiscard]] Slab slab_of(const Range& range) const {
    if (range.size() > largest_slab) return {};
    Eigen::Vector3d sum(0, 0, 0);
    for (int i = range.begin; i < range.end; ++i) {
      const int face = ranges_.order[static_cast<std::size_t>(i)];
      const Eigen::Vector3d& a = corner(face, 0);
      sum += (corner(face, 1) - a).cross(corner(face, 2) - a);
    }
    const double length = sum.norm();
    if (!(length > 0)) return {};
    Slab slab;
    slab.normal = (sum / length).cast<float>();
    const Eigen::Vector3d normal = slab.normal.cast<double>();
    double lo = static_cast<double>(huge);
    double hi = -lo;
    for (int i = range.begin; i < range.end; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double height = normal.dot(corner(ranges_.order[static_cast<std::size_t>(i)], k));
        lo = std::min(lo, height);
        hi = std::max(hi, height);
      }
    }
    slab.lo = static_cast<float>(lo) - box_margin;
    slab.hi = static_cast<float>(hi) + box_margin;
    return slab;
  }

  static void set_bounds(WideNode& node, int i, const Box& box, const Slab& slab) {
    for (int axis = 0; axis < 3; ++axis) {
      node.lo[static_cast<std::size_t>(axis)][i] = box.lo[axis];
      node.hi[static_cast<std::size_t>(axis)][i] = box.hi[axis];
      node.normal[static_cast<std::size_t>(axis)][i] = slab.normal[axis];
    }
    node.slab_lo[i] = slab.lo;
    node.slab_hi[i] = slab.hi;
  }

  std::int32_t make_leaf(const Range& range, Stretch& part) const {
    TriangleLeaf leaf{};
    for (int i = 0; i < leaf_size; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const int place = range.begin + std::min(i, range.size() - 1);
      const int face = ranges_.order[static_cast<std::size_t>(place)];
      leaf.face[slot] = i < range.size() ? face : ~face;
      for (int k = 0; k < 3; ++k) {
        leaf.vertex[static_cast<std::size_t>(k)][slot] = surface_.triangles(face, k);
      }
    }
    part.leaves.push_back(leaf);
    return static_cast<std::int32_t>(part.leaves.size()) - 1;
  }

  /// In the order in which the leaves use them.
  void place_vertices() {
    std::vector<std::int32_t> place(local_.size(), -1);
    tree_.vertices.reserve(local_.size());
    for (TriangleLeaf& leaf : tree_.leaves) {
      for (std::size_t slot = 0; slot < leaf_size; ++slot) {
        for (auto& corner : leaf.vertex) {
          std::int32_t& own = place[static_cast<std::size_t>(corner[slot])];
          if (own < 0) {
            own = static_cast<std::int32_t>(tree_.vertices.size());
            tree_.vertices.push_back(local_[static_cast<std::size_t>(corner[slot])]);
          }
          corner[slot] = own;
        }
      }
    }
  }

  const Surface& surface_;
  WideTree& tree_;
  int threads_;
  BinnedRanges ranges_;
  std::vector<Eigen::Vector3d> local_;
};

}  // namespace

WideTree build_wide_tree(const Surface& surface, int threads) {
  WideTree tree;
  const Eigen::Vector3d lower = surface.positions.colwise().minCoeff();
  const Eigen::Vector3d upper = surface.positions.colwise().maxCoeff();
  tree.centre = lower + (upper - lower) / 2;
  int exponent = 0;
  std::frexp((upper - lower).stableNorm(), &exponent);
  tree.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
  tree.lower = tree.to_local(lower);
  tree.upper = tree.to_local(upper);
  Builder(surface, tree, threads).build();
  return tree;
}

}  // namespace curveskel
