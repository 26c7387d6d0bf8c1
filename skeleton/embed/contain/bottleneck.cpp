#include "skeleton/embed/contain/bottleneck.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/contain/ball_chains.hpp"

namespace curveskel {
namespace {

/// True if the arc's nodes fall apart without the arc.
bool is_bridge(const SkeletonGraph& graph, int arc) {
  const Arc& given = graph.arcs[idx(arc)];
  std::vector<char> seen(graph.nodes.size(), 0);
  std::vector<int> open{given.from};
  seen[idx(given.from)] = 1;
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    for (const int s : graph.nodes[idx(node)].arcs) {
      if (s == arc) continue;
      for (const int next : {graph.arcs[idx(s)].from, graph.arcs[idx(s)].to}) {
        if (std::exchange(seen[idx(next)], 1) == 0) open.push_back(next);
      }
    }
  }
  return seen[idx(given.to)] == 0;
}

std::ptrdiff_t offset(std::size_t index) { return static_cast<std::ptrdiff_t>(index); }

/// A polyline with inscribed radii and the cost of the way up to each point.
struct Course {
  std::vector<CurvePoint> points;
  std::vector<Point> places;
  std::vector<double> radii;
  std::vector<double> cost;

  Course(std::vector<CurvePoint> line, const SurfaceTree& tree)
      : points(std::move(line)), cost(points.size(), 0) {
    for (const CurvePoint& point : points) {
      places.push_back(point.place());
      radii.push_back(std::max(point.radius(tree), least_radius));
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
      cost[i] = cost[i - 1] + step(i) / std::min(radii[i - 1], radii[i]);
    }
  }
  [[nodiscard]] double step(std::size_t i) const { return (places[i] - places[i - 1]).norm(); }
  [[nodiscard]] double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += step(i);
    return sum;
  }
  [[nodiscard]] double narrowest(std::size_t first, std::size_t last) const {
    return *std::min_element(radii.begin() + offset(first), radii.begin() + offset(last) + 1);
  }
};

/// Two places of a way, one on each side of a narrow one.
struct Ends {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The widest places on both sides of the narrowest that has such.
std::optional<Ends> around_the_narrowest(const Course& course, double wider) {
  const std::size_t count = course.points.size();
  std::vector<std::size_t> before(count);  // the widest up to here
  std::vector<std::size_t> behind(count);
  for (std::size_t i = 0; i < count; ++i) {
    before[i] = i == 0 || course.radii[i] > course.radii[before[i - 1]] ? i : before[i - 1];
    const std::size_t j = count - 1 - i;
    behind[j] = i == 0 || course.radii[j] > course.radii[behind[j + 1]] ? j : behind[j + 1];
  }
  std::optional<Ends> found;
  double least = 1 / wider;
  for (std::size_t k = 0; k < count; ++k) {
    const double share =
        course.radii[k] / std::min(course.radii[before[k]], course.radii[behind[k]]);
    if (share > least) continue;
    least = share;
    found = Ends{before[k], behind[k]};
  }
  return found;
}

struct Gain {
  Ends ends;
  double ratio = 0;  // of the costs of the old way and the new one between them
};

class Rerouting {
 public:
  Rerouting(SkeletonGraph& graph, const WorkingSurface& working, const PartitionGraph& partition,
            const SurfaceTree& tree, const BottleneckTuning& tuning, const std::stop_token& stop)
      : graph_(graph),
        partition_(partition),
        tree_(tree),
        tuning_(tuning),
        stop_(stop),
        chains_(working, partition) {}

  int run() {
    int count = 0;
    for (int s = 0; s < static_cast<int>(graph_.arcs.size()); ++s) {
      throw_if_stopped(stop_);
      const Arc& arc = graph_.arcs[idx(s)];
      if (!arc.alive || arc.from == arc.to) continue;
      const Course course(graph_.points_along(arc, tree_), tree_);
      const auto narrow = around_the_narrowest(course, tuning_.wider);
      if (narrow && is_bridge(graph_, s) && replace(graph_.arcs[idx(s)], course, *narrow)) {
        ++count;
      }
    }
    return count;
  }

 private:
  bool replace(Arc& arc, const Course& course, Ends around) {
    const auto groups = groups_along(graph_, arc, partition_);
    const Gain gain = most_to_gain(course, around, groups);
    if (gain.ratio < tuning_.cheaper) return false;
    const auto [first, last] = gain.ends;
    std::vector<CurvePoint> points(course.points.begin(),
                                   course.points.begin() + offset(first) + 1);
    const auto between = chains_.chain(course.places[first], course.places[last], groups);
    points.insert(points.end(), between.begin(), between.end());
    points.insert(points.end(), course.points.begin() + offset(last), course.points.end());
    const Course found(std::move(points), tree_);
    if (found.length() < tuning_.shortest * course.length()) return false;
    const std::size_t until = first + between.size() + 1;
    if (found.narrowest(first, until) < tuning_.wider * course.narrowest(first, last)) return false;
    arc.points.assign(found.points.begin() + 1, found.points.end() - 1);
    return true;
  }

  /// From the widest places on, first one end and then the other goes where the new way gains most.
  Gain most_to_gain(const Course& course, Ends ends, const std::vector<int>& groups) {
    double ratio = 0;
    const std::vector<int> holders = chains_.holders(course.places, groups);
    for (const bool first : {false, true, false}) {
      const std::size_t fixed = first ? ends.last : ends.first;
      const auto costs = chains_.costs(fixed, course.places, holders, groups);
      double most = 0;
      const std::size_t begin = first ? 0 : ends.first + 1;
      const std::size_t end = first ? ends.last : course.points.size();
      for (std::size_t i = begin; i < end; ++i) {
        const double own = std::abs(course.cost[i] - course.cost[fixed]);
        if (own - costs[i] <= most) continue;
        most = own - costs[i];
        ratio = own / costs[i];
        (first ? ends.first : ends.last) = i;
      }
      if (most == 0) return {};
    }
    return {ends, ratio};
  }

  SkeletonGraph& graph_;
  const PartitionGraph& partition_;
  const SurfaceTree& tree_;
  const BottleneckTuning& tuning_;
  const std::stop_token& stop_;
  BallChains chains_;
};

}  // namespace

int reroute_bottlenecks(SkeletonGraph& graph, const WorkingSurface& working,
                        const PartitionGraph& partition, const SurfaceTree& tree,
                        const BottleneckTuning& tuning, const std::stop_token& stop) {
  return Rerouting(graph, working, partition, tree, tuning, stop).run();
}

}  // namespace curveskel
