// Erickson and Whittlesey, Greedy optimal homotopy and homology generators, SODA 2005.
#include "surface/mesh/short_loops.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

/// Shortest ways along the edges from one vertex of each component to all others of it.
class ShortestWays {
 public:
  explicit ShortestWays(const Stars& stars)
      : stars_(stars),
        distance_(idx(stars.surface().positions.rows()), unreached),
        way_in_(distance_.size(), -1) {
    for (std::int32_t root = 0; root < std::ssize(distance_); ++root) {
      if (distance_[idx(root)] == unreached && stars.first(root) >= 0) spread(root);
    }
  }

  /// True if the edge is part of the tree.
  [[nodiscard]] bool has(std::int32_t h) const {
    return way_in_[idx(stars_.to(h))] == h || way_in_[idx(stars_.from(h))] == stars_.twin(h);
  }

  /// The length of the loop that an edge closes, infinite beyond `longest`.
  [[nodiscard]] double loop_length(std::int32_t h, double longest) const {
    double sum = stars_.length(h);
    std::int32_t a = stars_.from(h);
    std::int32_t b = stars_.to(h);
    while (a != b && sum <= longest) sum += step_back(farther(a, b));
    return sum <= longest ? sum : unreached;
  }

  [[nodiscard]] EdgeLoop loop(std::int32_t h) const {
    EdgeLoop before{stars_.from(h)};
    EdgeLoop behind{stars_.to(h)};
    while (before.back() != behind.back()) {
      std::int32_t a = before.back();
      std::int32_t b = behind.back();
      step_back(farther(a, b));
      if (a == before.back()) {
        behind.push_back(b);
      } else {
        before.push_back(a);
      }
    }
    behind.pop_back();  // they part at a vertex that `before` has, too
    std::reverse(before.begin(), before.end());
    before.insert(before.end(), behind.begin(), behind.end());
    return before;
  }

 private:
  void spread(std::int32_t root) {
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance_[idx(root)] = 0;
    queue.emplace(0, root);
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > distance_[idx(v)]) continue;
      std::int32_t h = stars_.first(v);
      do {
        const std::int32_t next = stars_.to(h);
        const double reached = distance + stars_.length(h);
        if (reached < distance_[idx(next)]) {
          distance_[idx(next)] = reached;
          way_in_[idx(next)] = h;
          queue.emplace(reached, next);
        }
        h = stars_.turned(h);
      } while (h != stars_.first(v));
    }
  }

  [[nodiscard]] std::int32_t& farther(std::int32_t& a, std::int32_t& b) const {
    return std::pair(distance_[idx(a)], a) > std::pair(distance_[idx(b)], b) ? a : b;
  }

  /// To the vertex before it on the way from the root; returns the length of the step.
  double step_back(std::int32_t& v) const {
    const std::int32_t in = way_in_[idx(v)];
    v = stars_.from(in);
    return stars_.length(in);
  }

  const Stars& stars_;
  std::vector<double> distance_;
  std::vector<std::int32_t> way_in_;  // the half-edge by which a vertex is reached, -1 = a root
};

/// The area beside a loop, as it is reached from there.
class AreaBeside {
 public:
  AreaBeside(const Stars& stars, double reach) : stars_(stars), reach_(reach) {}

  /// On the left of the loop; no more of it than exceeds `enough`.
  [[nodiscard]] double of(const EdgeLoop& loop, double enough) {
    for (const std::int32_t v : loop) distance_[v] = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t behind = loop[(i + loop.size() - 1) % loop.size()];
      std::int32_t h = stars_.between(loop[i], loop[(i + 1) % loop.size()]);
      for (; stars_.to(h) != behind; h = stars_.turned(h)) {
        take(h / 3);
        reach_along(h, 0);
      }
    }
    while (!queue_.empty() && area_ <= enough) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (distance > distance_.at(v)) continue;
      std::int32_t h = stars_.first(v);
      do {
        take(h / 3);
        reach_along(h, distance);
        h = stars_.turned(h);
      } while (h != stars_.first(v));
    }
    return area_;
  }

 private:
  using Entry = std::pair<double, std::int32_t>;

  void reach_along(std::int32_t h, double distance) {
    const double reached = distance + stars_.length(h);
    if (reached > reach_) return;
    const auto [known, is_new] = distance_.try_emplace(stars_.to(h), reached);
    if (!is_new && known->second <= reached) return;
    known->second = reached;
    queue_.emplace(reached, stars_.to(h));
  }

  /// A third of the face for each corner that is reached.
  void take(std::int32_t face) {
    const Surface& surface = stars_.surface();
    int& corners = corners_of_[face];
    if (++corners > 3) return;
    const Eigen::RowVector3d a = surface.positions.row(surface.triangles(face, 0));
    const Eigen::RowVector3d b = surface.positions.row(surface.triangles(face, 1));
    const Eigen::RowVector3d c = surface.positions.row(surface.triangles(face, 2));
    area_ += (b - a).cross(c - a).norm() / 6;
  }

  const Stars& stars_;
  double reach_;
  double area_ = 0;
  std::unordered_map<std::int32_t, double> distance_;
  std::unordered_map<std::int32_t, int> corners_of_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

Stars::Stars(const Surface& surface, const HalfEdges& pairs)
    : surface_(surface), pairs_(pairs), out_(idx(surface.positions.rows()), -1) {
  for (std::int32_t h = half_edges() - 1; h >= 0; --h) out_[idx(from(h))] = h;
}

std::int32_t Stars::between(std::int32_t from, std::int32_t to) const {
  std::int32_t h = first(from);
  while (this->to(h) != to) h = turned(h);
  return h;
}

double Stars::length(std::int32_t h) const {
  return (surface_.positions.row(to(h)) - surface_.positions.row(from(h))).norm();
}

std::vector<EdgeLoop> short_loops(const Stars& stars, double longest) {
  const ShortestWays ways(stars);
  UnionFind faces(stars.surface().triangles.rows());
  std::vector<std::pair<double, std::int32_t>> short_ones;
  for (std::int32_t h = 0; h < stars.half_edges(); ++h) {
    if (stars.twin(h) < h || ways.has(h)) continue;
    const double length = ways.loop_length(h, longest);
    if (length == unreached) {
      faces.unite(h / 3, stars.twin(h) / 3);
    } else {
      short_ones.emplace_back(length, h);
    }
  }
  // The longest edges first join the faces; those left over close the basis.
  std::sort(short_ones.begin(), short_ones.end(), std::greater<>());
  std::vector<EdgeLoop> loops;
  for (const auto& [length, h] : short_ones) {
    if (!faces.unite(h / 3, stars.twin(h) / 3)) loops.push_back(ways.loop(h));
  }
  std::reverse(loops.begin(), loops.end());
  return loops;
}

bool opens_out(const Stars& stars, const EdgeLoop& loop, double reach) {
  const double tube = reach * reach;
  const EdgeLoop other_way(loop.rbegin(), loop.rend());
  return AreaBeside(stars, reach).of(loop, tube) > tube &&
         AreaBeside(stars, reach).of(other_way, tube) > tube;
}

}  // namespace curveskel
