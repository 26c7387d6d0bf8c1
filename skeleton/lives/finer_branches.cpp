#include "skeleton/lives/finer_branches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include "skeleton/graph/draft.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// A place on an edge.
struct Place {
  std::pair<int, int> edge;
  double share = 0;  ///< of the way from the edge's first node
  Vector3d point = Vector3d::Zero();
  double off = 0;  ///< a target's distance from the ball there
};

struct Tip {
  const TipLife* life = nullptr;
  double rim_radius = 0;
  double beyond = std::numeric_limits<double>::infinity();  ///< the curve's balls
  bool has_leaf = false;

  [[nodiscard]] double deficit() const { return std::min(life->life, beyond / rim_radius); }
};

/// A tip, or two that are each other's images.
using Twins = std::vector<Tip>;

/// Of those that have no leaf yet; 0 if both have.
double mean_deficit(const Twins& twins) {
  double sum = 0;
  int count = 0;
  for (const Tip& tip : twins) {
    if (tip.has_leaf) continue;
    sum += tip.deficit();
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

class FinerBranches {
 public:
  FinerBranches(const CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                double spacing)
      : surface_(surface),
        tree_(tree),
        least_rim_(spacing),
        curve_(skeleton),
        neighbours_(graph_of(surface.positions.rows(), index_edges(surface.triangles).edges)),
        seen_(idx(surface.positions.rows()), 0) {
    double length = 0;
    for (const auto& [a, b] : curve_.edges()) {
      length += (curve_.position(a) - curve_.position(b)).norm();
    }
    spacing_ = length / static_cast<double>(curve_.edges().size());
  }

  int run(const std::vector<TipLife>& lives, const std::vector<int>& mirror_axes, double least) {
    std::vector<Twins> open = with_images(lives, mirror_axes);
    look_at_nodes_from(0, open);
    look_for_leaves(open);
    int drawn = 0;
    while (!open.empty()) {
      const auto most = std::max_element(
          open.begin(), open.end(),
          [](const Twins& a, const Twins& b) { return mean_deficit(a) < mean_deficit(b); });
      if (mean_deficit(*most) < least) break;
      const int before = curve_.nodes();
      for (const Tip& tip : *most) drawn += !tip.has_leaf && draw(*tip.life) ? 1 : 0;
      open.erase(most);
      look_at_nodes_from(before, open);
    }
    return drawn;
  }

  [[nodiscard]] CurveSkeleton finished() const { return curve_.finish(); }

 private:
  [[nodiscard]] Vector3d vertex(int v) const { return surface_.positions.row(v); }

  /// The rim of a hair counts as no smaller than points of the curve lie apart.
  [[nodiscard]] Tip tip_of(const TipLife& life) const {
    return {&life, std::max(life.rim_radius, least_rim_)};
  }

  /// Each tip once: images lie within their rims' radii of each other.
  [[nodiscard]] std::vector<Twins> with_images(const std::vector<TipLife>& lives,
                                               const std::vector<int>& mirror_axes) const {
    std::vector<Twins> found;
    std::vector<char> taken(lives.size(), 0);
    for (std::size_t k = 0; k < lives.size(); ++k) {
      if (taken[k] != 0 || !(lives[k].rim_radius > 0)) continue;
      found.push_back({tip_of(lives[k])});
      double nearest = lives[k].rim_radius;
      std::size_t twin = k;
      for (const int axis : mirror_axes) {
        Vector3d image = vertex(lives[k].vertex);
        image[axis] = -image[axis];
        for (std::size_t other = k + 1; other < lives.size(); ++other) {
          const double distance = (vertex(lives[other].vertex) - image).norm();
          const double most = std::min(nearest, lives[other].rim_radius);
          if (taken[other] != 0 || !(distance < most)) continue;
          nearest = distance;
          twin = other;
        }
      }
      if (twin == k) continue;
      taken[twin] = 1;
      found.back().push_back(tip_of(lives[twin]));
    }
    return found;
  }

  void look_at_nodes_from(int first, std::vector<Twins>& open) const {
    for (Twins& twins : open) {
      for (Tip& tip : twins) {
        const Vector3d end = vertex(tip.life->vertex);
        for (int node = first; node < curve_.nodes(); ++node) {
          const double off = (curve_.position(node) - end).norm() - curve_.radius(node);
          tip.beyond = std::min(tip.beyond, off);
        }
      }
    }
  }

  /// A leaf that ends in the tip's part of the surface, between its rim and its vertex, is its own,
  /// however far it keeps from the vertex: another one would run beside it in the same limb. One
  /// that the tip's end does not see is a neighbour's. Of a bent limb, whose end lies on no
  /// straight way from its rim, the leaf is the one that ends within two of its radii of the
  /// vertex.
  void look_for_leaves(std::vector<Twins>& open) const {
    std::vector<int> degree(idx(curve_.nodes()), 0);
    for (const auto& [a, b] : curve_.edges()) {
      ++degree[idx(a)];
      ++degree[idx(b)];
    }
    std::vector<int> leaves;
    for (int node = 0; node < curve_.nodes(); ++node) {
      if (degree[idx(node)] == 1) leaves.push_back(node);
    }
    for (Twins& twins : open) {
      for (Tip& tip : twins) {
        const Vector3d& rim = tip.life->rim;
        const Vector3d ahead = vertex(tip.life->vertex) - rim;
        tip.has_leaf = std::any_of(leaves.begin(), leaves.end(), [&](int leaf) {
          const Vector3d at = curve_.position(leaf);
          const double distance = (at - vertex(tip.life->vertex)).norm();
          const bool is_no_wider = curve_.radius(leaf) <= tip.rim_radius;
          if (is_no_wider && distance <= 2 * curve_.radius(leaf)) return true;
          if (distance > ahead.norm()) return false;
          if (!((at - rim).dot(ahead) > 0)) return false;
          const std::optional<Vector3d> end = end_of(*tip.life);
          return end.has_value() && sees(at, *end);
        });
      }
    }
  }

  [[nodiscard]] bool sees(const Vector3d& from, const Vector3d& to) const {
    const double distance = (to - from).norm();
    return !(distance > 0) || tree_.ray(from, (to - from) / distance, distance).triangle < 0;
  }

  bool draw(const TipLife& tip) {
    const std::optional<Vector3d> end = end_of(tip);
    if (!end) return false;
    const std::optional<Place> base = base_for(tip.rim);
    if (!base) return false;
    std::vector<Vector3d> way;
    if (!sees(base->point, *end)) way.push_back(tip.rim);
    way.push_back(*end);
    int node = node_at(*base);
    std::vector<int> made;
    for (const Vector3d& next : way) {
      const Vector3d from = curve_.position(node);
      const int pieces = pieces_of((next - from).norm());
      for (int k = 1; k <= pieces; ++k) {
        const Vector3d point = from + static_cast<double>(k) / pieces * (next - from);
        const int added = curve_.add(point, 0, &tree_);
        curve_.connect(node, added);
        made.push_back(node = added);
      }
    }
    curve_.set_life(node, tip.life);
    hand_over(tip, made);
    return true;
  }

  /// Edges about as long as the curve's, but no shorter than a tenth of the least spacing: its own
  /// may have no length.
  [[nodiscard]] int pieces_of(double length) const {
    const double each = std::max(spacing_, 0.1 * least_rim_);
    return each > 0 ? std::max(1, static_cast<int>(length / each)) : 1;
  }

  /// The centre of the ball that touches the surface behind the rim, in the direction of the tip;
  /// half-way there if the rim's centre does not see it.
  [[nodiscard]] std::optional<Vector3d> end_of(const TipLife& tip) const {
    const Vector3d way = vertex(tip.vertex) - tip.rim;
    if (!(way.norm() > 0) || !tree_.inside(tip.rim)) return std::nullopt;
    const Vector3d ahead = way.normalized();
    const double reach = tree_.ray(tip.rim, ahead).distance;
    if (!std::isfinite(reach)) return std::nullopt;
    const SurfaceTree::Ball ball = tree_.inscribed_ball(tip.rim + reach * ahead, -ahead);
    const bool fits = ball.radius < reach && sees(tip.rim, ball.centre);
    return fits ? ball.centre : Vector3d(tip.rim + 0.5 * reach * ahead);
  }

  /// Of the places that see the target the one whose ball is nearest.
  [[nodiscard]] std::optional<Place> base_for(const Vector3d& target) const {
    std::vector<Place> places;
    for (const auto& edge : curve_.edges()) add_places_on(edge, target, places);
    // One of the first sees it as a rule, so that a heap does with fewer comparisons than sorting.
    std::vector<std::pair<double, std::size_t>> nearest;
    nearest.reserve(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) nearest.emplace_back(places[k].off, k);
    std::make_heap(nearest.begin(), nearest.end(), std::greater<>());
    while (!nearest.empty()) {
      const Place& place = places[nearest.front().second];
      if (sees(place.point, target)) return place;
      std::pop_heap(nearest.begin(), nearest.end(), std::greater<>());
      nearest.pop_back();
    }
    return std::nullopt;
  }

  /// Half an inscribed radius apart, but not nearer than a hundredth of the edge.
  void add_places_on(const std::pair<int, int>& edge, const Vector3d& target,
                     std::vector<Place>& places) const {
    const Vector3d from = curve_.position(edge.first);
    const Vector3d way = curve_.position(edge.second) - from;
    const double radius = curve_.radius(edge.first);
    const double growth = curve_.radius(edge.second) - radius;
    const double step = std::max(0.5 * std::min(radius, radius + growth), 0.01 * way.norm());
    const int pieces = step > 0 ? static_cast<int>(std::ceil(way.norm() / step)) : 1;
    for (int k = 0; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / std::max(1, pieces);
      const Vector3d point = from + share * way;
      const double off = (point - target).norm() - (radius + share * growth);
      places.push_back({edge, share, point, off});
    }
  }

  int node_at(const Place& place) {
    const auto [a, b] = place.edge;
    if (place.share <= 0) return a;
    if (place.share >= 1) return b;
    const int node = curve_.add(place.point, 0, &tree_);
    curve_.disconnect(a, b);
    curve_.connect(a, node);
    curve_.connect(node, b);
    return node;
  }

  /// The vertices from the tip to the plane through the rim go to the nearest of the new nodes, if
  /// it is nearer than the one that they have: in a ring the plane leaves half of it on that side.
  void hand_over(const TipLife& tip, const std::vector<int>& made) {
    const Vector3d ahead = vertex(tip.vertex) - tip.rim;
    std::vector<int> part{tip.vertex};
    seen_[idx(tip.vertex)] = 1;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vector3d at = vertex(part[i]);
      const auto squared = [&](int node) { return (curve_.position(node) - at).squaredNorm(); };
      const auto nearest = std::min_element(made.begin(), made.end(),
                                            [&](int a, int b) { return squared(a) < squared(b); });
      if (squared(*nearest) > squared(curve_.node_of_vertex(part[i]))) continue;
      curve_.hand_vertex(part[i], *nearest);
      for (const int next : neighbours_.neighbours(part[i])) {
        if (seen_[idx(next)] != 0 || !((vertex(next) - tip.rim).dot(ahead) > 0)) continue;
        seen_[idx(next)] = 1;
        part.push_back(next);
      }
    }
    for (const int v : part) seen_[idx(v)] = 0;
  }

  const Surface& surface_;
  const SurfaceTree& tree_;
  double least_rim_;
  Draft curve_;
  Graph neighbours_;        // of vertices
  std::vector<char> seen_;  // by vertex, of the part that is handed over; else 0
  double spacing_ = 0;      // the mean length of an edge at first
};

}  // namespace

int add_finer_branches(CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                       const std::vector<TipLife>& lives, const std::vector<int>& mirror_axes,
                       double least, double spacing) {
  if (skeleton.edges.rows() == 0) return 0;
  FinerBranches finer(skeleton, surface, tree, spacing);
  const int drawn = finer.run(lives, mirror_axes, least);
  if (drawn > 0) skeleton = finer.finished();
  return drawn;
}

}  // namespace curveskel
