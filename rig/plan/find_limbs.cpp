#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/curve_tree.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

// Of the body's size. Below the first a tip lies in the mirror plane, within the second an
// unpaired one still counts so.
constexpr double in_plane = 0.006;
constexpr double nearly_in_plane = 0.015;
constexpr double alike = 0.06;  // so near is a mirror image

int thickest_of(const CurveTree& tree) {
  const auto most = std::max_element(tree.radii.begin(), tree.radii.end());
  return static_cast<int>(most - tree.radii.begin());
}

class PairFinder {
 public:
  PairFinder(const CurveTree& tree, Images images)
      : tree_(tree),
        images_(images),
        tips_(tips_of(tree)),
        from_first_(ways_from(tree, 0)),
        thickest_(thickest_of(tree)) {}

  TipPairs find() {
    pair_tips();
    for (const auto& [left, right] : found_.mate) {
      const int node = crossing(left, right);
      if (std::find(found_.ends.begin(), found_.ends.end(), node) == found_.ends.end()) {
        found_.ends.push_back(node);
      }
    }
    return std::move(found_);
  }

 private:
  /// Left tips and their images: the nearest pairs first.
  void pair_tips() {
    std::vector<std::tuple<double, int, int>> candidates = images_near();
    std::sort(candidates.begin(), candidates.end());
    std::vector<char> taken(tree_.nodes.size(), 0);
    for (const auto& [off, left, right] : candidates) {
      if (taken[idx(left)] != 0 || taken[idx(right)] != 0) continue;
      taken[idx(left)] = taken[idx(right)] = 1;
      found_.mate[left] = right;
    }
    if (images_ == Images::within_limbs) pair_with_nodes(taken);
    for (const int tip : tips_) {
      const double aside = std::abs(tree_.aside(tip)) / tree_.size;
      const double in_the_middle = taken[idx(tip)] == 0 ? nearly_in_plane : in_plane;
      if (aside <= in_the_middle && side_of_branch(tip) == 0) found_.ends.push_back(tip);
    }
  }

  /// Of a tip in the plane: inner toes that meet there come from one side. How far aside its branch
  /// forks, at most, on the way to the thickest place; 0 where that is near the plane.
  [[nodiscard]] double side_of_branch(int tip) const {
    double most = 0;
    for (const int node : from_first_.between(tip, thickest_)) {
      const bool is_fork = tree_.neighbours[idx(node)].size() > 2;
      if (is_fork && std::abs(tree_.aside(node)) > std::abs(most)) most = tree_.aside(node);
    }
    return std::abs(most) > alike * tree_.size ? most : 0;
  }

  /// Above 0 on the left; 0 in the plane.
  [[nodiscard]] double side_of(int tip) const {
    const double aside = tree_.aside(tip);
    return std::abs(aside) > in_plane * tree_.size ? aside : side_of_branch(tip);
  }

  /// Left tips, and right ones whose images are near them: those in the neighbouring cells.
  [[nodiscard]] std::vector<std::tuple<double, int, int>> images_near() const {
    using Cell = std::array<int, 3>;
    std::vector<std::tuple<double, int, int>> near;
    if (!(tree_.size > 0)) return near;
    const double side = (1 + 1e-9) * alike * tree_.size;  // more than rounding takes
    const auto cell_of = [&](const Vector3d& place) {
      const Eigen::Array3d cell =
          ((place - tree_.nodes[idx(tips_.front())]) / side).array().floor();
      return Cell{static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])};
    };
    std::map<Cell, std::vector<std::pair<int, Vector3d>>> images;
    for (const int right : tips_) {
      if (side_of(right) >= 0) continue;
      Vector3d image = tree_.nodes[idx(right)];
      image.x() = 2 * tree_.middle - image.x();
      images[cell_of(image)].emplace_back(right, image);
    }
    for (const int left : tips_) {
      if (side_of(left) <= 0) continue;
      const Cell own = cell_of(tree_.nodes[idx(left)]);
      for (int k = 0; k < 27; ++k) {
        const auto found =
            images.find({own[0] + k / 9 - 1, own[1] + k / 3 % 3 - 1, own[2] + k % 3 - 1});
        if (found == images.end()) continue;
        for (const auto& [right, image] : found->second) {
          const double off = (image - tree_.nodes[idx(left)]).norm();
          if (off < alike * tree_.size) near.emplace_back(off, left, right);
        }
      }
    }
    return near;
  }

  /// Tips that have no tip for an image, with the node on the other side that is: of a hand that
  /// holds a weapon, whose tip is the weapon's.
  void pair_with_nodes(std::vector<char>& taken) {
    for (const int tip : tips_) {
      if (taken[idx(tip)] != 0 || std::abs(tree_.aside(tip)) <= in_plane * tree_.size) continue;
      Vector3d image = tree_.nodes[idx(tip)];
      image.x() = 2 * tree_.middle - image.x();
      int nearest = -1;
      double least = alike * tree_.size;
      for (int node = 0; node < static_cast<int>(tree_.nodes.size()); ++node) {
        const bool is_opposite = tree_.aside(node) * tree_.aside(tip) < 0 &&
                                 std::abs(tree_.aside(node)) > in_plane * tree_.size;
        const double off = (image - tree_.nodes[idx(node)]).norm();
        if (!is_opposite || taken[idx(node)] != 0 || off >= least) continue;
        nearest = node;
        least = off;
      }
      if (nearest < 0) continue;
      taken[idx(tip)] = taken[idx(nearest)] = 1;
      const bool is_left = tree_.aside(tip) > 0;
      found_.mate[is_left ? tip : nearest] = is_left ? nearest : tip;
    }
  }

  /// The length of the path up to each of its nodes.
  template <typename Iterator>
  [[nodiscard]] std::vector<double> walked(Iterator begin, Iterator end) const {
    std::vector<double> lengths{0};
    for (Iterator next = begin + 1; next < end; ++next) {
      lengths.push_back(lengths.back() +
                        (tree_.nodes[idx(*next)] - tree_.nodes[idx(*(next - 1))]).norm());
    }
    return lengths;
  }

  /// Where the way from a tip to its image crosses the mirror plane: of what lies near the plane
  /// the node that is as far from both.
  [[nodiscard]] int crossing(int left, int right) const {
    const std::vector<int> path = from_first_.between(left, right);
    const std::vector<double> from_left = walked(path.begin(), path.end());
    const std::vector<double> from_right = walked(path.rbegin(), path.rend());
    double least = std::numeric_limits<double>::infinity();
    for (const int node : path) least = std::min(least, std::abs(tree_.aside(node)));
    const double near = std::max(0.01 * tree_.size, 1.5 * least);
    int best = path.front();
    double best_off = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < path.size(); ++k) {
      const int node = path[k];
      if (std::abs(tree_.aside(node)) >= near && std::abs(tree_.aside(node)) > least) continue;
      const double off = std::abs(from_left[k] - from_right[path.size() - 1 - k]);
      if (off >= best_off) continue;
      best_off = off;
      best = node;
    }
    return best;
  }

  const CurveTree& tree_;
  Images images_;
  std::vector<int> tips_;
  Ways from_first_;  // node, to all
  int thickest_;
  TipPairs found_;
};

class LimbFinder {
 public:
  LimbFinder(const CurveTree& tree, const TipPairs& pairs)
      : tree_(tree), mate_(pairs.mate), ends_(pairs.ends) {}

  Limbs find() {
    find_trunk();
    const std::vector<std::vector<int>> parts = parts_beside_trunk();
    const std::vector<std::vector<int>> vertices = vertices_of(parts);
    for (std::size_t k = 0; k < parts.size(); ++k) add_pair(parts[k], vertices[k]);
    std::stable_sort(limbs_.pairs.begin(), limbs_.pairs.end(),
                     [](const LimbPair& a, const LimbPair& b) { return a.length > b.length; });
    return std::move(limbs_);
  }

 private:
  void find_trunk() {
    limbs_.is_trunk.assign(tree_.nodes.size(), 0);
    if (ends_.empty()) {
      ends_.push_back(thickest_of(tree_));
    }
    // In a tree the ways between all ends are those from one of them to the others.
    from_end_ = ways_from(tree_, ends_.front());
    for (const int end : ends_) {
      for (const int node : from_end_.path(end)) limbs_.is_trunk[idx(node)] = 1;
    }
    for (int node = 0; node < static_cast<int>(tree_.nodes.size()); ++node) {
      if (limbs_.is_trunk[idx(node)] != 0) limbs_.trunk.push_back(node);
    }
  }

  [[nodiscard]] std::vector<std::vector<int>> parts_beside_trunk() const {
    std::vector<std::vector<int>> parts;
    std::vector<char> seen = limbs_.is_trunk;
    for (int node = 0; node < static_cast<int>(tree_.nodes.size()); ++node) {
      if (seen[idx(node)] == 0) parts.push_back(part_of(tree_, node, seen));
    }
    return parts;
  }

  /// Of the surface, those of each part's nodes.
  [[nodiscard]] std::vector<std::vector<int>> vertices_of(
      const std::vector<std::vector<int>>& parts) const {
    std::vector<int> part_of_node(tree_.nodes.size(), -1);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      for (const int node : parts[k]) part_of_node[idx(node)] = static_cast<int>(k);
    }
    std::vector<std::vector<int>> vertices(parts.size());
    for (std::size_t v = 0; v < tree_.vertices.size(); ++v) {
      const int node = tree_.node_of_vertex[v];
      if (node < 0 || part_of_node[idx(node)] < 0) continue;
      vertices[idx(part_of_node[idx(node)])].push_back(static_cast<int>(v));
    }
    return vertices;
  }

  /// In a tree there is one way, so that those from the trunk's end, which are known, have it.
  [[nodiscard]] std::vector<int> way_between(int root, int node) const {
    return std::isfinite(from_end_.distance[idx(root)]) ? from_end_.between(root, node)
                                                        : ways_from(tree_, root).path(node);
  }

  [[nodiscard]] double length_of(const std::vector<int>& path) const {
    double length = 0;
    for (std::size_t k = 1; k < path.size(); ++k) {
      length += (tree_.nodes[idx(path[k])] - tree_.nodes[idx(path[k - 1])]).norm();
    }
    return length;
  }

  void add_pair(const std::vector<int>& part, const std::vector<int>& vertices) {
    if (std::none_of(part.begin(), part.end(), [&](int node) { return mate_.count(node) > 0; })) {
      return;
    }
    LimbPair pair;
    for (const int node : part) {
      for (const int next : tree_.neighbours[idx(node)]) {
        if (pair.root < 0 && limbs_.is_trunk[idx(next)] != 0) pair.root = next;
      }
    }
    if (pair.root < 0) return;
    for (const int node : part) {
      if (mate_.count(node) == 0) continue;
      std::vector<int> path = way_between(pair.root, node);
      const double length = length_of(path);
      pair.ways.push_back({std::move(path), way_between(pair.root, mate_.at(node)), length});
    }
    if (pair.ways.empty()) return;
    std::stable_sort(pair.ways.begin(), pair.ways.end(),
                     [](const LimbWay& a, const LimbWay& b) { return a.length > b.length; });
    pair.length = pair.ways.front().length;
    pair.lowest = std::numeric_limits<double>::infinity();
    for (const int node : part) pair.lowest = std::min(pair.lowest, tree_.nodes[idx(node)].y());
    pair.vertices = vertices;
    for (const int v : vertices) pair.lowest = std::min(pair.lowest, tree_.vertices[idx(v)].y());
    limbs_.pairs.push_back(std::move(pair));
  }

  const CurveTree& tree_;
  const std::map<int, int>& mate_;
  std::vector<int> ends_;
  Ways from_end_;  // the first, to all
  Limbs limbs_;
};

}  // namespace

TipPairs pairs_by_place(const CurveTree& tree, Images images) {
  return PairFinder(tree, images).find();
}

Limbs find_limbs(const CurveTree& tree, const TipPairs& pairs) {
  return LimbFinder(tree, pairs).find();
}

}  // namespace curveskel
