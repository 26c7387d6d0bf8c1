#include "skeleton/embed/branches/grow_branches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/arc_projection.hpp"
#include "skeleton/embed/branches/prominence.hpp"

namespace curveskel {
namespace {

constexpr int most_passes = 8;

struct Apex {
  int vertex = -1;
  int node = -1;  // where the branch begins, -1 = at the vertex's projection
  double prominence = 0;
  Point tip = Point::Zero();
};

class Growth {
 public:
  Growth(SkeletonGraph& graph, const WorkingSurface& working, const SurfaceTree& tree,
         const PartitionGraph& partition, const GrowthTuning& tuning, const std::stop_token& stop,
         int threads)
      : graph_(graph),
        working_(working),
        tree_(tree),
        partition_(partition),
        tuning_(tuning),
        stop_(stop),
        threads_(threads),
        sweep_(working),
        projections_(idx(working.vertices())),
        grown_(projections_.size(), 0) {}

  int run(double limit) {
    int count = 0;
    for (int pass = 0; pass < most_passes; ++pass) {
      projections_ = project_on_arcs(graph_, working_, partition_, threads_);
      const int before = count;
      touched_.clear();
      for (const Apex& apex : apices(limit)) count += grow(apex) ? 1 : 0;
      if (count == before) break;
    }
    return count;
  }

 private:
  [[nodiscard]] Point place(int v) const { return working_.place(v); }
  [[nodiscard]] double height(int v) const {
    return (place(v) - projections_[idx(v)].place).norm();
  }

  /// The node that stands for a place of an arc: the tip whose ball holds it, or the node that is
  /// there; -1 if there is none.
  [[nodiscard]] int node_at(const ArcProjection& projection, double radius) const {
    const Arc& arc = graph_.arcs[idx(projection.arc)];
    for (const int node : {arc.from, arc.to}) {
      const double distance = (graph_.place(node) - projection.place).norm();
      if (distance == 0 || (graph_.degree(node) == 1 && distance <= radius)) return node;
    }
    return -1;
  }

  [[nodiscard]] Protrusion protrusion(const Point& base, int apex) {
    const auto is_own = [&](int v) {
      return (projections_[idx(v)].place - base).norm() <
             tuning_.entered * (place(v) - base).norm();
    };
    return sweep_(base, apex, is_own, std::numeric_limits<double>::infinity(),
                  tuning_.fewest_vertices);
  }

  /// Of two vertices of equal height, as symmetric limbs have them, the later is lower: one of any
  /// number of equals is the highest.
  [[nodiscard]] bool is_lower(int a, int b) const {
    return std::pair(height(a), -a) < std::pair(height(b), -b);
  }

  /// Vertices from which no edge leads farther away from the graph.
  [[nodiscard]] std::vector<int> farthest_around() const {
    std::vector<char> lower(projections_.size(), 0);
    for (const auto& t : working_.surface().triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        const int a = t(k);
        const int b = t((k + 1) % 3);
        lower[idx(is_lower(a, b) ? a : b)] = 1;
      }
    }
    std::vector<int> vertices;
    for (int v = 0; v < static_cast<int>(projections_.size()); ++v) {
      if (lower[idx(v)] == 0 && projections_[idx(v)].arc >= 0 && grown_[idx(v)] == 0) {
        vertices.push_back(v);
      }
    }
    return vertices;
  }

  /// The branch from a node, or from the vertex's projection where there is none; no vertex if
  /// there can be none.
  [[nodiscard]] Apex made(int v, int node, const SurfaceTree::Ball& root, const Protrusion& found,
                          double least_prominence, double least_ball) {
    if (found.prominence < least_prominence) return {};
    const Point inwards = found.boundary_centre - place(v);
    const auto ball = tree_.inscribed_ball(place(v), inwards.normalized());
    const double share = ball.radius / root.radius;
    if (!(share > least_ball && share < tuning_.most_ball)) return {};
    return {v, node, found.prominence, tip(found, root, ball.centre)};
  }

  /// In the middle of a blunt end, rather than in the corner where the apex is.
  [[nodiscard]] Point tip(const Protrusion& part, const SurfaceTree::Ball& root,
                          const Point& at_apex) const {
    const Point outwards = part.cap_centre - part.boundary_centre;
    if (!(outwards.norm() > 0) || !tree_.inside(part.boundary_centre)) return at_apex;
    const Point direction = outwards.normalized();
    const double reach = tree_.ray(part.boundary_centre, direction).distance;
    if (!std::isfinite(reach)) return at_apex;
    const Point end = part.boundary_centre + reach * direction;
    const auto ball = tree_.inscribed_ball(end, -direction);
    const double off = tuning_.beyond * root.radius;
    if (ball.radius < reach && (ball.centre - root.centre).norm() > off) return ball.centre;
    const Point nearer_the_end = root.centre + off * (end - root.centre).normalized();
    const bool fits = tree_.inscribed_radius(nearer_the_end) > tuning_.least_tip_ball * root.radius;
    return fits ? nearer_the_end : at_apex;
  }

  [[nodiscard]] Apex extension(int v, int tip) {
    const Point& base = graph_.place(tip);
    const SurfaceTree::Ball root{base, graph_.nodes[idx(tip)].point.radius(tree_)};
    if ((place(v) - base).norm() < tuning_.least_extension * root.radius) return {};
    return made(v, tip, root, protrusion(base, v), tuning_.least_extension_prominence,
                tuning_.least_extension_ball);
  }

  [[nodiscard]] Apex branch(int v, int node, double radius, double limit) {
    const ArcProjection& projection = projections_[idx(v)];
    Protrusion best = protrusion(projection.place, v);
    Point base = projection.place;
    const Arc& arc = graph_.arcs[idx(projection.arc)];
    for (const int end : {arc.from, arc.to}) {
      const Point& junction = graph_.place(end);
      if (graph_.degree(end) < 3) continue;
      if ((junction - projection.place).norm() > tuning_.least_branch * radius) continue;
      const Protrusion here = protrusion(junction, v);
      if (here.prominence <= best.prominence) continue;
      best = here;
      base = junction;
      node = end;
    }
    return made(v, node, {base, radius}, best, limit, tuning_.least_branch_ball);
  }

  /// Those that deserve a branch, most prominent first.
  [[nodiscard]] std::vector<Apex> apices(double limit) {
    std::vector<Apex> found;
    for (const int v : farthest_around()) {
      throw_if_stopped(stop_);
      const double radius = tree_.inscribed_radius(projections_[idx(v)].place);
      if (height(v) < tuning_.least_branch * radius) continue;
      const int node = node_at(projections_[idx(v)], radius);
      const bool extends = node >= 0 && graph_.degree(node) == 1;
      const Apex apex = extends ? extension(v, node) : branch(v, node, radius, limit);
      if (apex.vertex >= 0) found.push_back(apex);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Apex& a, const Apex& b) { return a.prominence > b.prominence; });
    return found;
  }

  /// False if the arcs there have changed since the projections were found.
  bool grow(const Apex& apex) {
    const ArcProjection& projection = projections_[idx(apex.vertex)];
    int base = apex.node;
    std::vector<int> around{projection.arc};
    if (base >= 0) {
      const auto& there = graph_.nodes[idx(base)].arcs;
      around.insert(around.end(), there.begin(), there.end());
    }
    const auto is_around = [&](int s) {
      return std::find(around.begin(), around.end(), s) != around.end();
    };
    if (std::any_of(touched_.begin(), touched_.end(), is_around)) return false;
    std::vector<int> groups = groups_on(around, projections_, partition_);
    if (base < 0) base = graph_.split(projection.arc, projection.segment, projection.place);
    const int tip = graph_.add_leaf(base, apex.tip, std::move(groups));
    grown_[idx(apex.vertex)] = 1;
    touched_.insert(touched_.end(), around.begin(), around.end());
    touched_.push_back(graph_.nodes[idx(tip)].arcs.front());
    return true;
  }

  SkeletonGraph& graph_;
  const WorkingSurface& working_;
  const SurfaceTree& tree_;
  const PartitionGraph& partition_;
  const GrowthTuning& tuning_;
  const std::stop_token& stop_;
  int threads_;
  ProminenceSweep sweep_;
  std::vector<ArcProjection> projections_;  // per vertex
  std::vector<char> grown_;                 // per vertex: it has had its branch
  std::vector<int> touched_;                // arcs, in this pass
};

}  // namespace

int grow_branches(SkeletonGraph& graph, const WorkingSurface& working, const SurfaceTree& tree,
                  const PartitionGraph& partition, double limit, const GrowthTuning& tuning,
                  const std::stop_token& stop, int threads) {
  return Growth(graph, working, tree, partition, tuning, stop, threads).run(limit);
}

}  // namespace curveskel
