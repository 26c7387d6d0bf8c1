// I. Wald, On fast construction of SAH-based bounding volume hierarchies, 2007.
#include "surface/spatial/wide_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace curveskel {
namespace {

constexpr int most_bins = 16;
constexpr int leaf_size = 4;
constexpr int median_depth = 48;  // binary splits; below it ranges are halved, so depth is bounded
constexpr int largest_slab = 1024;  // triangles; larger pieces of a surface are no flat patches
constexpr float huge = 1e30F;

Float4 minimum(Float4 a, Float4 b) { return a < b ? a : b; }
Float4 maximum(Float4 a, Float4 b) { return a > b ? a : b; }

struct Box {
  Float4 lo{huge, huge, huge, huge};
  Float4 hi{-huge, -huge, -huge, -huge};

  void include(const Box& other) {
    lo = minimum(lo, other.lo);
    hi = maximum(hi, other.hi);
  }
  void include(Float4 point) {
    lo = minimum(lo, point);
    hi = maximum(hi, point);
  }
  [[nodiscard]] float half_area() const {
    const Float4 d = hi - lo;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

struct Range {
  int begin = 0;
  int end = 0;
  int depth = 0;
  Box box;
  Box centroids;  // of the boxes, doubled
  [[nodiscard]] int size() const { return end - begin; }
  void include(const Box& member) {
    box.include(member);
    centroids.include(member.lo + member.hi);
  }
};

class Builder {
 public:
  Builder(const Surface& surface, WideTree& tree) : surface_(surface), tree_(tree) {
    const auto faces = static_cast<int>(surface.triangles.rows());
    local_.resize(static_cast<std::size_t>(surface.positions.rows()));
    for (std::size_t v = 0; v < local_.size(); ++v) {
      local_[v] = tree.to_local(surface.positions.row(static_cast<Eigen::Index>(v)));
    }
    place_.assign(local_.size(), -1);
    tree_.vertices.reserve(local_.size());
    boxes_.resize(static_cast<std::size_t>(faces));
    order_.resize(static_cast<std::size_t>(faces));
    for (int f = 0; f < faces; ++f) {
      boxes_[static_cast<std::size_t>(f)] = box_of(f);
      order_[static_cast<std::size_t>(f)] = f;
    }
    tree_.nodes.reserve(static_cast<std::size_t>(faces) / 6 + 1);
    tree_.leaves.reserve(static_cast<std::size_t>(faces) / 3 + 1);
  }

  void build() { make_node(measured(0, static_cast<int>(order_.size()), 0)); }

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

  [[nodiscard]] Range measured(int begin, int end, int depth) const {
    Range range{begin, end, depth, {}, {}};
    for (int i = begin; i < end; ++i) range.include(boxes_[static_cast<std::size_t>(i)]);
    return range;
  }

  // The bin of a box by its doubled centroid along the axis of the split.
  struct Axis {
    int index;
    int bins;
    float lower;
    float factor;
    [[nodiscard]] int bin(const Box& box) const {
      const float value = box.lo[index] + box.hi[index];
      return std::min(bins - 1, static_cast<int>((value - lower) * factor));
    }
  };

  [[nodiscard]] std::pair<Range, Range> split(const Range& range) {
    const Float4 extent = range.centroids.hi - range.centroids.lo;
    int index = 0;
    if (extent[1] > extent[index]) index = 1;
    if (extent[2] > extent[index]) index = 2;
    if (extent[index] > 0 && range.depth < median_depth) {
      const int bins = std::clamp(range.size() / 2, 4, most_bins);
      const Axis axis{index, bins, range.centroids.lo[index],
                      static_cast<float>(bins) / extent[index]};
      auto halves = partition(range, axis, cheapest_cut(range, axis));
      if (halves.first.size() > 0 && halves.second.size() > 0) return halves;
    }
    const int middle = (range.begin + range.end) / 2;
    return {measured(range.begin, middle, range.depth + 1),
            measured(middle, range.end, range.depth + 1)};
  }

  // Members of bins up to last_left come first.
  [[nodiscard]] std::pair<Range, Range> partition(const Range& range, const Axis& axis,
                                                  int last_left) {
    Range left{range.begin, range.begin, range.depth + 1, {}, {}};
    Range right{range.end, range.end, range.depth + 1, {}, {}};
    while (left.end < right.begin) {
      const auto i = static_cast<std::size_t>(left.end);
      if (axis.bin(boxes_[i]) <= last_left) {
        left.include(boxes_[i]);
        ++left.end;
      } else {
        right.include(boxes_[i]);
        const auto j = static_cast<std::size_t>(--right.begin);
        std::swap(boxes_[i], boxes_[j]);
        std::swap(order_[i], order_[j]);
      }
    }
    return {left, right};
  }

  // The last bin on the left of the cut whose sides cost least to visit.
  [[nodiscard]] int cheapest_cut(const Range& range, const Axis& axis) const {
    std::array<Box, most_bins> box;
    std::array<int, most_bins> count{};
    for (int i = range.begin; i < range.end; ++i) {
      const Box& member = boxes_[static_cast<std::size_t>(i)];
      const auto bin = static_cast<std::size_t>(axis.bin(member));
      box[bin].include(member);
      ++count[bin];
    }
    const auto cost = [](const Box& side, int members) {
      const int leaves = (members + leaf_size - 1) / leaf_size;
      return members == 0 ? 0.0F : side.half_area() * static_cast<float>(leaves);
    };
    std::array<float, most_bins> cost_right{};
    Box side;
    int members = 0;
    const auto bins = static_cast<std::size_t>(axis.bins);
    for (std::size_t i = bins - 1; i > 0; --i) {
      side.include(box[i]);
      members += count[i];
      cost_right[i] = cost(side, members);
    }
    int best = 0;
    float best_cost = std::numeric_limits<float>::infinity();
    side = Box{};
    members = 0;
    for (std::size_t i = 0; i + 1 < bins; ++i) {
      side.include(box[i]);
      members += count[i];
      const float total = cost(side, members) + cost_right[i + 1];
      if (total < best_cost) {
        best_cost = total;
        best = static_cast<int>(i);
      }
    }
    return best;
  }

  std::int32_t make_node(const Range& whole) {
    std::array<Range, 4> ranges{whole};
    int used = 1;
    while (used < 4) {
      int widest = -1;
      float area = -1;
      for (int i = 0; i < used; ++i) {
        const Range& range = ranges[static_cast<std::size_t>(i)];
        if (range.size() > leaf_size && range.box.half_area() > area) {
          area = range.box.half_area();
          widest = i;
        }
      }
      if (widest < 0) break;
      auto& range = ranges[static_cast<std::size_t>(widest)];
      std::tie(range, ranges[static_cast<std::size_t>(used++)]) = split(range);
    }

    const auto index = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::array<std::int32_t, 4> child{-1, -1, -1, -1};
    for (int i = 0; i < used; ++i) {
      const Range& range = ranges[static_cast<std::size_t>(i)];
      child[static_cast<std::size_t>(i)] =
          range.size() > leaf_size ? make_node(range) : ~make_leaf(range);
    }
    WideNode& node = tree_.nodes[static_cast<std::size_t>(index)];
    node.child = child;
    for (int i = 0; i < 4; ++i) {
      const bool in_use = i < used;
      const Range& range = ranges[static_cast<std::size_t>(i)];
      set_bounds(node, i, in_use ? range.box : Box{}, in_use ? slab_of(range) : Slab{});
    }
    return index;
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
      const int face = order_[static_cast<std::size_t>(i)];
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
        const double height = normal.dot(corner(order_[static_cast<std::size_t>(i)], k));
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

  std::int32_t make_leaf(const Range& range) {
    TriangleLeaf leaf{};
    for (int i = 0; i < leaf_size; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const int place = range.begin + std::min(i, range.size() - 1);
      const int face = order_[static_cast<std::size_t>(place)];
      leaf.face[slot] = i < range.size() ? face : ~face;
      for (int k = 0; k < 3; ++k) {
        leaf.vertex[static_cast<std::size_t>(k)][slot] = placed(surface_.triangles(face, k));
      }
    }
    tree_.leaves.push_back(leaf);
    return static_cast<std::int32_t>(tree_.leaves.size()) - 1;
  }

  std::int32_t placed(std::int32_t vertex) {
    std::int32_t& place = place_[static_cast<std::size_t>(vertex)];
    if (place < 0) {
      place = static_cast<std::int32_t>(tree_.vertices.size());
      tree_.vertices.push_back(local_[static_cast<std::size_t>(vertex)]);
    }
    return place;
  }

  const Surface& surface_;
  WideTree& tree_;
  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Eigen::Vector3d> local_;
  std::vector<std::int32_t> place_;  // of a vertex among tree_.vertices, -1 = none yet
};

}  // namespace

WideTree build_wide_tree(const Surface& surface) {
  WideTree tree;
  const Eigen::Vector3d lower = surface.positions.colwise().minCoeff();
  const Eigen::Vector3d upper = surface.positions.colwise().maxCoeff();
  tree.centre = lower + (upper - lower) / 2;
  int exponent = 0;
  std::frexp((upper - lower).stableNorm(), &exponent);
  tree.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
  tree.lower = tree.to_local(lower);
  tree.upper = tree.to_local(upper);
  Builder(surface, tree).build();
  return tree;
}

}  // namespace curveskel
