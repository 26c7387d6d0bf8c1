#include "skeleton/embed/contain/ball_chains.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>

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

BallChains::BallChains(const WorkingSurface& working, const PartitionGraph& partition)
    : working_(working), balls_(working.balls()), partition_(partition) {}

void BallChains::prepare() {
  if (!vertices_.empty()) return;
  paths_ = ShortestPaths(working_.vertices());
  vertices_.resize(idx(partition_.groups));
  allowed_.assign(vertices_.size(), 0);
  for (int v = 0; v < working_.vertices(); ++v) {
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
  return paths_.path_to(to);
}

std::vector<int> BallChains::way_through_all(int from, int to, const std::vector<int>& groups) {
  passes_all_ = true;
  std::vector<int> found = way(from, to, groups);
  passes_all_ = false;
  return found;
}

std::vector<int> BallChains::holders(const std::vector<Point>& places,
                                     const std::vector<int>& groups) {
  prepare();
  std::vector<int> holders;
  holders.reserve(places.size());
  for (const Point& place : places) holders.push_back(holder_of(place, groups));
  return holders;
}

std::vector<double> BallChains::costs(std::size_t from, const std::vector<Point>& places,
                                      const std::vector<int>& holders,
                                      const std::vector<int>& groups) {
  std::vector<double> costs(places.size(), no_way);
  const int source = holders[from];
  if (source < 0) return costs;
  search(source, ShortestPaths::no_target, groups);
  const auto from_ball = [&](std::size_t place) {
    return distance(places[place], holders[place]) / balls_.radii[holders[place]];
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    costs[i] = from_ball(from) + paths_.distance(holders[i]) + from_ball(i);
  }
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

/// From one vertex through the groups until the other is reached, or all are.
void BallChains::search(int source, int target, const std::vector<int>& groups) {
  for (const int group : groups) allowed_[idx(group)] = 1;
  paths_.search(working_.neighbours(), source, target, [&](int v, int next, int /*edge*/) {
    if (!may_pass(next) || is_avoided(v, next)) return ShortestPaths::unreachable;
    const double step = (balls_.centres.row(v) - balls_.centres.row(next)).norm();
    return step / std::max(least_radius, std::min(balls_.radii[v], balls_.radii[next]));
  });
  for (const int group : groups) allowed_[idx(group)] = 0;
}

bool BallChains::may_pass(int v) const {
  return allowed_[idx(partition_.group_of_vertex[v])] != 0 &&
         (passes_all_ || balls_.radii[v] > least_radius);
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
