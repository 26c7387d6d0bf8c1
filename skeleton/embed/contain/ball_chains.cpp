#include "skeleton/embed/contain/ball_chains.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "base/indices.hpp"

namespace curveskel {
namespace {

constexpr double no_way = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<int> groups_among(std::vector<int> nodes, const PartitionGraph& partition) {
  std::erase_if(nodes, [&](int node) { return node >= partition.groups; });
  return nodes;
}

std::vector<int> groups_along(const SkeletonGraph& graph, const Arc& arc,
                              const PartitionGraph& partition) {
  std::vector<int> nodes = arc.pieces;
  for (const int node : {arc.from, arc.to}) {
    const auto& more = graph.nodes[idx(node)].pieces;
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  return groups_among(std::move(nodes), partition);
}

BallChains::BallChains(const Surface& surface, const InscribedBalls& balls,
                       const PartitionGraph& partition)
    : surface_(surface), balls_(balls), partition_(partition) {}

void BallChains::prepare() {
  if (!neighbours_.empty()) return;
  neighbours_.resize(idx(surface_.positions.rows()));
  vertices_.resize(idx(partition_.groups));
  allowed_.assign(vertices_.size(), 0);
  cost_.assign(neighbours_.size(), no_way);
  previous_.assign(neighbours_.size(), -1);
  for (const auto& [a, b] : index_edges(surface_.triangles).edges) {
    neighbours_[idx(a)].push_back(b);
    neighbours_[idx(b)].push_back(a);
  }
  for (int v = 0; v < static_cast<int>(neighbours_.size()); ++v) {
    if (balls_.radii[v] > least_radius) vertices_[idx(partition_.group_of_vertex[v])].push_back(v);
  }
}

std::vector<int> BallChains::way_between(const Point& p, const Point& q,
                                         const std::vector<int>& groups) {
  prepare();
  const int source = holder_of(p, groups);
  const int target = holder_of(q, groups);
  if (source < 0 || target < 0) return {};
  return way(source, target, groups);
}

std::vector<Point> BallChains::chain(const Point& p, const Point& q,
                                     const std::vector<int>& groups) {
  std::vector<Point> points;
  for (const int v : way_between(p, q, groups)) points.push_back(balls_.centres.row(v));
  return points;
}

std::vector<int> BallChains::way(int from, int to, const std::vector<int>& groups) {
  prepare();
  search(from, to, groups);
  std::vector<int> vertices;
  for (int v = std::isfinite(cost_[idx(to)]) ? to : -1; v >= 0; v = previous_[idx(v)]) {
    vertices.push_back(v);
  }
  std::reverse(vertices.begin(), vertices.end());
  forget();
  return vertices;
}

std::vector<double> BallChains::costs(const Point& p, const std::vector<Point>& places,
                                      const std::vector<int>& groups) {
  prepare();
  std::vector<double> costs(places.size(), no_way);
  const int source = holder_of(p, groups);
  if (source < 0) return costs;
  search(source, -1, groups);
  const auto from_ball = [&](const Point& place, int v) {
    return distance(place, v) / balls_.radii[v];
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int target = holder_of(places[i], groups);
    costs[i] = from_ball(p, source) + cost_[idx(target)] + from_ball(places[i], target);
  }
  forget();
  return costs;
}

int BallChains::nearest_vertex(const Point& p, const std::vector<int>& groups) {
  prepare();
  return least_of(groups, [&](int v) { return distance(p, v); });
}

Point BallChains::nearest_centre(const Point& p, const std::vector<int>& groups) {
  const int best = nearest_vertex(p, groups);
  return best < 0 ? p : Point(balls_.centres.row(best));
}

/// Dijkstra's from one vertex through the groups until the other is reached, or all are.
void BallChains::search(int source, int target, const std::vector<int>& groups) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const int group : groups) allowed_[idx(group)] = 1;
  cost_[idx(source)] = 0;
  reached_.push_back(source);
  queue.emplace(0, source);
  while (!queue.empty()) {
    const auto [so_far, v] = queue.top();
    queue.pop();
    if (v == target) break;
    if (so_far > cost_[idx(v)]) continue;
    for (const int next : neighbours_[idx(v)]) {
      if (!may_pass(next) || is_avoided(v, next)) continue;
      const double step = (balls_.centres.row(v) - balls_.centres.row(next)).norm();
      const double narrow = std::min(balls_.radii[v], balls_.radii[next]);
      const double total = so_far + step / narrow;
      if (total >= cost_[idx(next)]) continue;
      if (previous_[idx(next)] < 0) reached_.push_back(next);
      cost_[idx(next)] = total;
      previous_[idx(next)] = v;
      queue.emplace(total, next);
    }
  }
  for (const int group : groups) allowed_[idx(group)] = 0;
}

void BallChains::forget() {
  for (const int v : std::exchange(reached_, {})) {
    cost_[idx(v)] = no_way;
    previous_[idx(v)] = -1;
  }
}

bool BallChains::may_pass(int v) const {
  return allowed_[idx(partition_.group_of_vertex[v])] != 0 && balls_.radii[v] > least_radius;
}

void BallChains::avoid(int one, int other) { avoided_.insert(std::minmax(one, other)); }

bool BallChains::is_avoided(int one, int other) const {
  return !avoided_.empty() && avoided_.contains(std::minmax(one, other));
}

double BallChains::distance(const Point& p, int v) const {
  return (balls_.centres.row(v).transpose() - p).norm();
}

/// The vertex of these groups with the least value, the first of them if several; -1 if none.
template <typename Value>
int BallChains::least_of(const std::vector<int>& groups, const Value& value) const {
  int best = -1;
  double least = no_way;
  for (const int group : groups) {
    for (const int v : vertices_[idx(group)]) {
      const double here = value(v);
      if (here > least || (here == least && best < v)) continue;
      least = here;
      best = v;
    }
  }
  return best;
}

/// The vertex whose ball holds the point best.
int BallChains::holder_of(const Point& p, const std::vector<int>& groups) const {
  return least_of(groups, [&](int v) { return distance(p, v) - balls_.radii[v]; });
}

}  // namespace curveskel
