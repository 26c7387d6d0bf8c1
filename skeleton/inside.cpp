#include "skeleton/inside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "skeleton/relax.hpp"
#include "surface/element_index.hpp"

namespace curveskel {
namespace {

constexpr double least_radius = 1e-5;
constexpr int deepest = 10;

/// Inside and away from the surface, or moved there if that can be done nearby.
Point pulled_inside(const SurfaceTree& tree, const Point& p) {
  const double radius = tree.inscribed_radius(p);
  if (radius >= least_radius) return p;
  const auto nearest = tree.nearest(p);
  Point inward = radius < 0 ? Point(nearest.point - p) : Point(p - nearest.point);
  if (inward.norm() == 0) return p;
  inward.normalize();
  const auto ball = tree.inscribed_ball(nearest.point, inward);
  if (!std::isfinite(ball.radius) || tree.inscribed_radius(ball.centre) <= radius) return p;
  return ball.centre;
}

/// Appends the points that have to come between p and q, straight where that stays inside, bent
/// inwards where not. False if some gap could not be covered; `inserted` is then best left unused.
class Cover {
 public:
  Cover(const SurfaceTree& tree, bool may_bend) : tree_(tree), may_bend_(may_bend) {}

  bool between(const Point& p, const Point& q, std::vector<Point>& inserted) const {
    return between(p, tree_.inscribed_radius(p), q, tree_.inscribed_radius(q), 0, inserted);
  }

 private:
  bool between(const Point& p, double p_radius, const Point& q, double q_radius, int depth,
               std::vector<Point>& inserted) const {
    const double length = (q - p).norm();
    if (p_radius > 0 && q_radius > 0 && length <= p_radius + q_radius) return true;
    if (depth == deepest || p_radius <= 0 || q_radius <= 0) return false;
    Point middle = 0.5 * (p + q);
    double radius = tree_.inscribed_radius(middle);
    if (radius < least_radius) {
      if (!may_bend_) return false;
      const Point moved = pulled_inside(tree_, middle);
      // A centre far from both ends belongs to another part of the surface.
      if ((moved - middle).norm() > length) return false;
      middle = moved;
      radius = tree_.inscribed_radius(middle);
    }
    if (!between(p, p_radius, middle, radius, depth + 1, inserted)) return false;
    inserted.push_back(middle);
    return between(middle, radius, q, q_radius, depth + 1, inserted);
  }

  const SurfaceTree& tree_;
  bool may_bend_;
};

/// Cheapest chains of the vertices' inscribed balls from neighbour to neighbour. A question takes
/// as long as the groups asked about have vertices, however many others there are.
class BallChains {
 public:
  BallChains(const Surface& surface, const InscribedBalls& balls, const VertexGraph& graph)
      : balls_(balls),
        graph_(graph),
        neighbours_(at(surface.positions.rows())),
        vertices_(at(graph.groups)),
        allowed_(at(graph.groups), 0),
        cost_(neighbours_.size(), infinity),
        previous_(neighbours_.size(), -1) {
    for (const auto& [a, b] : index_edges(surface.triangles).edges) {
      neighbours_[at(a)].push_back(b);
      neighbours_[at(b)].push_back(a);
    }
    for (int v = 0; v < static_cast<int>(neighbours_.size()); ++v) {
      if (balls.radii[v] > least_radius) vertices_[at(graph.group_of_vertex[v])].push_back(v);
    }
  }

  /// Ball centres from about p to about q through vertices of the given groups; empty if there is
  /// no way. Going far and going through small balls both cost.
  [[nodiscard]] std::vector<Point> chain(const Point& p, const Point& q,
                                         const std::vector<int>& groups) {
    const int source = holder_of(p, groups);
    const int target = holder_of(q, groups);
    if (source < 0 || target < 0) return {};
    for (const int group : groups) allowed_[at(group)] = 1;
    search(source, target);
    for (const int group : groups) allowed_[at(group)] = 0;
    std::vector<Point> points;
    for (int v = std::isfinite(cost_[at(target)]) ? target : -1; v >= 0; v = previous_[at(v)]) {
      points.push_back(balls_.centres.row(v));
    }
    std::reverse(points.begin(), points.end());
    for (const int v : std::exchange(reached_, {})) {
      cost_[at(v)] = infinity;
      previous_[at(v)] = -1;
    }
    return points;
  }

  /// The ball centre nearest to p of the vertices of the given groups; p if they have none.
  [[nodiscard]] Point nearest_centre(const Point& p, const std::vector<int>& groups) const {
    const int best = least_of(groups, [&](int v) { return distance(p, v); });
    return best < 0 ? p : Point(balls_.centres.row(best));
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Dijkstra's from one vertex until the other is reached.
  void search(int source, int target) {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost_[at(source)] = 0;
    reached_.push_back(source);
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [so_far, v] = queue.top();
      queue.pop();
      if (v == target) break;
      if (so_far > cost_[at(v)]) continue;
      for (const int next : neighbours_[at(v)]) {
        if (!may_pass(next)) continue;
        const double step = (balls_.centres.row(v) - balls_.centres.row(next)).norm();
        const double narrow = std::min(balls_.radii[v], balls_.radii[next]);
        const double total = so_far + step / narrow;
        if (total >= cost_[at(next)]) continue;
        if (previous_[at(next)] < 0) reached_.push_back(next);
        cost_[at(next)] = total;
        previous_[at(next)] = v;
        queue.emplace(total, next);
      }
    }
  }

  [[nodiscard]] bool may_pass(int v) const {
    return allowed_[at(graph_.group_of_vertex[v])] != 0 && balls_.radii[v] > least_radius;
  }

  [[nodiscard]] double distance(const Point& p, int v) const {
    return (balls_.centres.row(v).transpose() - p).norm();
  }

  /// The vertex of these groups with the least value, the first of them if several; -1 if none.
  template <typename Value>
  [[nodiscard]] int least_of(const std::vector<int>& groups, const Value& value) const {
    int best = -1;
    double least = infinity;
    for (const int group : groups) {
      for (const int v : vertices_[at(group)]) {
        const double here = value(v);
        if (here > least || (here == least && best < v)) continue;
        least = here;
        best = v;
      }
    }
    return best;
  }

  /// The vertex whose ball holds the point best.
  [[nodiscard]] int holder_of(const Point& p, const std::vector<int>& groups) const {
    return least_of(groups, [&](int v) { return distance(p, v) - balls_.radii[v]; });
  }

  const InscribedBalls& balls_;
  const VertexGraph& graph_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<std::vector<int>> vertices_;  // of each group, those with a ball
  // What one search leaves for the next to clear.
  std::vector<char> allowed_;  // per group
  std::vector<double> cost_;
  std::vector<int> previous_;
  std::vector<int> reached_;
};

/// Leaves out the points of a chain that a straight line inside makes needless.
std::vector<Point> shortcut(const std::vector<Point>& chain, const SurfaceTree& tree) {
  const Cover straight(tree, false);
  std::vector<Point> kept{chain.front()};
  for (std::size_t i = 0; i + 1 < chain.size();) {
    std::size_t next = i + 1;
    std::vector<Point> unused;
    for (std::size_t step = 2; i + step < chain.size(); step *= 2) {
      if (!straight.between(chain[i], chain[i + step], unused)) break;
      next = i + step;
    }
    kept.push_back(chain[next]);
    i = next;
  }
  return kept;
}

class Keeper {
 public:
  Keeper(Network& network, const Surface& surface, const InscribedBalls& balls,
         const VertexGraph& graph, const SurfaceTree& tree)
      : network_(network), surface_(surface), balls_(balls), graph_(graph), tree_(tree) {}

  int run() {
    for (Hub& hub : network_.hubs) {
      if (!hub.alive) continue;
      hub.position = pulled_inside(tree_, hub.position);
      if (tree_.inscribed_radius(hub.position) < least_radius) {
        hub.position = chains().nearest_centre(hub.position, groups_of(hub.nodes));
      }
    }
    for (Strand& strand : network_.strands) {
      if (strand.alive) cover_strand(strand);
    }
    return uncovered_;
  }

 private:
  void cover_strand(Strand& strand) {
    for (Point& p : strand.points) p = pulled_inside(tree_, p);
    const auto line = network_.polyline(strand);
    const auto radii = radii_at(tree_, line);
    std::vector<Point> points;
    std::size_t i = 0;
    while (i + 1 < line.size()) {
      std::size_t next = i + 1;
      std::vector<Point> between;
      if (!Cover(tree_, true).between(line[i], line[next], between)) {
        // From the last point that is inside to the next one.
        while (next + 1 < line.size() && radii[next] < least_radius) ++next;
        between = detour(strand, line[i], line[next]);
      }
      points.insert(points.end(), between.begin(), between.end());
      if (next + 1 < line.size()) points.push_back(line[next]);
      i = next;
    }
    strand.points = std::move(points);
  }

  [[nodiscard]] std::vector<int> groups_of(std::vector<int> nodes) const {
    std::erase_if(nodes, [&](int node) { return node >= graph_.groups; });
    return nodes;
  }

  std::vector<Point> detour(const Strand& strand, const Point& p, const Point& q) {
    std::vector<int> nodes = strand.nodes;
    for (const int hub : {strand.from, strand.to}) {
      const auto& more = network_.hubs[at(hub)].nodes;
      nodes.insert(nodes.end(), more.begin(), more.end());
    }
    auto chain = chains().chain(p, q, groups_of(nodes));
    if (chain.empty()) {
      ++uncovered_;
      return {};
    }
    chain.insert(chain.begin(), p);
    chain.push_back(q);
    chain = shortcut(chain, tree_);
    std::vector<Point> points;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      if (i > 0) points.push_back(chain[i]);
      std::vector<Point> between;
      if (Cover(tree_, true).between(chain[i], chain[i + 1], between)) {
        points.insert(points.end(), between.begin(), between.end());
      } else {
        ++uncovered_;
      }
    }
    return points;
  }

  /// Rarely needed, and as much work as all the rest.
  BallChains& chains() {
    if (!chains_) chains_.emplace(surface_, balls_, graph_);
    return *chains_;
  }

  Network& network_;
  const Surface& surface_;
  const InscribedBalls& balls_;
  const VertexGraph& graph_;
  const SurfaceTree& tree_;
  std::optional<BallChains> chains_;
  int uncovered_ = 0;
};

}  // namespace

int keep_inside(Network& network, const Surface& surface, const InscribedBalls& balls,
                const VertexGraph& graph, const SurfaceTree& tree) {
  return Keeper(network, surface, balls, graph, tree).run();
}

}  // namespace curveskel
