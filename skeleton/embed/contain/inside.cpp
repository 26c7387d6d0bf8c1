#include "skeleton/embed/contain/inside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/contain/ball_chains.hpp"
#include "skeleton/embed/contain/below_surface.hpp"
#include "skeleton/embed/contain/cover.hpp"
#include "skeleton/embed/contain/ways_below.hpp"
#include "skeleton/embed/place/shorten.hpp"
#include "skeleton/embed/place/spacing.hpp"

namespace curveskel {
namespace {

/// Leaves out the points of a chain that a straight line inside makes needless.
std::vector<CurvePoint> shortcut(const std::vector<CurvePoint>& chain, const SurfaceTree& tree) {
  const Cover straight(tree, false);
  return shortened(chain, [&](std::size_t first, std::size_t last) {
    std::vector<CurvePoint> unused;
    return straight.between(chain[first], chain[last], unused);
  });
}

class Keeper {
 public:
  Keeper(SkeletonGraph& graph, const WorkingSurface& working, const PartitionGraph& partition,
         const SurfaceTree& tree, HomologyGuard& handles, const InsideOptions& options)
      : graph_(graph),
        working_(working),
        balls_(working.balls()),
        partition_(partition),
        tree_(tree),
        handles_(handles),
        options_(options),
        chains_(working, partition) {
    if (options.below != nullptr) ways_below_.emplace(*options.below, tree, options.stop);
  }

  int run() {
    for (Node& node : graph_.nodes) {
      if (!node.alive) continue;
      node.point = pulled_inside(tree_, node.point);
      if (node.point.radius(tree_) < least_radius) {
        node.point =
            chains_.nearest_centre(node.point.place(), groups_among(node.pieces, partition_));
      }
    }
    std::vector<char> on_cycle(graph_.arcs.size(), 0);
    if (handles_.has_handles()) {
      for (const int s : core(graph_)) on_cycle[idx(s)] = 1;
    }
    for (std::size_t s = 0; s < graph_.arcs.size(); ++s) {
      throw_if_stopped(options_.stop);
      if (graph_.arcs[s].alive) cover_arc(graph_.arcs[s], on_cycle[s] != 0);
      if (options_.all_or_nothing && uncovered_ > 0) break;
    }
    return uncovered_;
  }

 private:
  void pull_inside(Arc& arc, bool on_cycle) {
    const auto given = graph_.polyline(arc);
    for (std::size_t k = 1; k + 1 < given.size(); ++k) {
      CurvePoint& point = arc.points[k - 1];
      const CurvePoint moved = pulled_inside(tree_, point);
      const Point& before = k == 1 ? given.front() : arc.points[k - 2].place();
      if (on_cycle && moved.place() != given[k] &&
          !handles_.homologous({before, given[k], given[k + 1]},
                               {before, moved.place(), given[k + 1]})) {
        continue;
      }
      point = moved;
    }
  }

  /// From one point of an arc to another that comes after it.
  struct Stretch {
    std::size_t last = 0;
    std::vector<CurvePoint> between;
    int uncovered = 0;
  };

  /// To the next point straight or bent, else by a detour to the next one inside; where none leads
  /// there, as in a pocket where the surface meets itself, to one of the points after it. `covered`
  /// are the arc's points up to there.
  Stretch next_stretch(Arc& arc, const std::vector<CurvePoint>& line, std::size_t i, bool on_cycle,
                       const std::vector<CurvePoint>& covered) {
    constexpr std::size_t most_left_out = 4;
    Stretch straight{i + 1, {}, 0};
    const bool is_whole = is_covered(line[i], line[i + 1], straight.between);
    if (is_whole && (!on_cycle || keeps_handle(line, i, straight))) return straight;
    straight.between.clear();
    straight.uncovered = crosses(tree_, line[i].place(), line[i + 1].place()) ? 1 : 0;
    std::size_t next = i + 1;
    // From the last point that is inside to the next one.
    while (next + 1 < line.size() && line[next].radius(tree_) < least_radius) ++next;
    std::optional<Stretch> best;
    // A cycle that leaves points out may leave its handle with them.
    const std::size_t left_out = on_cycle ? 0 : most_left_out;
    const std::size_t farthest = std::min(next + left_out, line.size() - 1);
    for (; next <= farthest; ++next) {
      Stretch stretch = detour(arc, line, i, next);
      if (on_cycle && !keeps_handle(line, i, stretch)) continue;
      if (!best || stretch.uncovered < best->uncovered) best = std::move(stretch);
      if (best->uncovered == 0) break;
    }
    if (!best) best = std::move(straight);
    if (best->uncovered == 0 || !ways_below_) return std::move(*best);
    auto below = stretch_below(arc, line, i, on_cycle, covered);
    return below ? std::move(*below) : std::move(*best);
  }

  /// Just below the full surface to the next point that is inside. A line that crosses the surface
  /// goes round no handle of the inside, so of a cycle any way will do with which the graph goes
  /// round all of them. Where no way does, the handle is missed whatever becomes of the others.
  std::optional<Stretch> stretch_below(Arc& arc, const std::vector<CurvePoint>& line, std::size_t i,
                                       bool on_cycle, const std::vector<CurvePoint>& covered) {
    if (on_cycle && misses_handle_) return std::nullopt;
    std::size_t next = i + 1;
    while (next + 1 < line.size() && line[next].radius(tree_) <= 0) ++next;
    if (line[i].radius(tree_) <= 0 || line[next].radius(tree_) <= 0) return std::nullopt;
    bool was_asked = false;
    const auto finds_all = [&](const std::vector<Point>& way) {
      was_asked = true;
      const std::vector<CurvePoint> before = arc.points;
      const auto at = [&](std::size_t k) { return line.begin() + static_cast<std::ptrdiff_t>(k); };
      arc.points = covered;
      for (const Point& point : way) arc.points.emplace_back(point);
      arc.points.insert(arc.points.end(), at(next), std::max(at(next), line.end() - 1));
      const bool all = handles_.finds_all_handles(graph_, partition_);
      arc.points = before;
      return all;
    };
    const auto way = on_cycle ? ways_below_->between(line[i], line[next], handles_, finds_all)
                              : ways_below_->between(line[i], line[next]);
    if (was_asked && !way) misses_handle_ = true;
    if (!way) return std::nullopt;
    Stretch stretch{next, {}, 0};
    for (const Point& point : *way) stretch.between.emplace_back(point);
    return stretch;
  }

  [[nodiscard]] bool keeps_handle(const std::vector<CurvePoint>& line, std::size_t first,
                                  const Stretch& stretch) {
    if (stretch.between.empty() && stretch.last == first + 1) return true;
    std::vector<Point> is{line[first].place()};
    for (const CurvePoint& point : stretch.between) is.push_back(point.place());
    is.push_back(line[stretch.last].place());
    std::vector<Point> was;
    for (std::size_t k = first; k <= stretch.last; ++k) was.push_back(line[k].place());
    return handles_.homologous(was, is);
  }

  void cover_arc(Arc& arc, bool on_cycle) {
    constexpr int most_detours = 4;  // more run to and fro over the same ground
    pull_inside(arc, on_cycle);
    const auto line = graph_.points_along(arc, tree_);
    std::vector<CurvePoint> points;
    std::optional<Stretch> whole;
    int uncovered = 0;
    bool one_way_tried = false;
    detours_ = 0;
    for (std::size_t i = 0; i + 1 < line.size();) {
      if (detours_ > most_detours && !std::exchange(one_way_tried, true)) {
        whole = one_way(arc, line, on_cycle);
        if (whole && whole->uncovered == 0) break;
      }
      Stretch stretch = next_stretch(arc, line, i, on_cycle, points);
      uncovered += stretch.uncovered;
      points.insert(points.end(), stretch.between.begin(), stretch.between.end());
      if (stretch.last + 1 < line.size()) points.push_back(line[stretch.last]);
      i = stretch.last;
    }
    const bool takes_whole = whole && (whole->uncovered == 0 || whole->uncovered < uncovered);
    arc.points = takes_whole ? std::move(whole->between) : std::move(points);
    uncovered_ += takes_whole ? whole->uncovered : uncovered;
  }

  /// A part of a way through the balls of some groups, and the point to which it leads.
  struct Leg {
    std::vector<int> groups;
    CurvePoint end;
  };

  /// The arc as one way from ball to ball, which passes none twice: from node to node, or by two of
  /// its groups round a closed arc. Nothing if it leaves the arc's handle.
  std::optional<Stretch> one_way(const Arc& arc, const std::vector<CurvePoint>& line,
                                 bool on_cycle) {
    const auto legs = arc.from == arc.to
                          ? legs_round(arc, line)
                          : std::vector<Leg>{{groups_along(graph_, arc, partition_), line.back()}};
    if (legs.empty()) return std::nullopt;
    Stretch whole{line.size() - 1, {}, 0};
    CurvePoint here = line.front();
    for (const Leg& leg : legs) {
      if (&leg != &legs.front()) whole.between.push_back(here);
      const auto made = round_hidden_steps(here, leg.end, leg.groups);
      if (!made) return std::nullopt;
      whole.between.insert(whole.between.end(), made->points.begin(), made->points.end());
      whole.uncovered += made->uncovered;
      here = leg.end;
    }
    if (on_cycle && !keeps_handle(line, 0, whole)) return std::nullopt;
    return whole;
  }

  /// Three legs through the groups of a closed arc, in their order; none if these are too few.
  std::vector<Leg> legs_round(const Arc& arc, const std::vector<CurvePoint>& line) {
    const auto ends = groups_among(graph_.nodes[idx(arc.from)].pieces, partition_);
    const auto groups = groups_among(arc.pieces, partition_);
    if (groups.size() < 2) return {};
    const std::size_t first = (groups.size() - 1) / 3;
    const std::size_t second = groups.size() - 1 - first;
    const int one = chains_.nearest_vertex(line[line.size() / 3].place(), {groups[first]});
    const int other = chains_.nearest_vertex(line[2 * line.size() / 3].place(), {groups[second]});
    if (one < 0 || other < 0) return {};
    const auto at = [&](std::size_t i) { return groups.begin() + static_cast<std::ptrdiff_t>(i); };
    std::vector<int> before(groups.begin(), at(first + 1));
    std::vector<int> behind(at(second), groups.end());
    before.insert(before.end(), ends.begin(), ends.end());
    behind.insert(behind.end(), ends.begin(), ends.end());
    return {
        {before, centre(one)}, {{at(first), at(second + 1)}, centre(other)}, {behind, line.back()}};
  }

  /// True if nothing needs to come between two points, or those that have to do. No straight line
  /// between two points inside that meets no surface leaves it, however small their balls.
  bool is_covered(const CurvePoint& p, const CurvePoint& q,
                  std::vector<CurvePoint>& between) const {
    if (Cover(tree_, true).between(p, q, between)) return true;
    between.clear();
    return sees_straight(tree_, p, q);
  }

  bool sees(const CurvePoint& p, const CurvePoint& q) const {
    std::vector<CurvePoint> unused;
    return is_covered(p, q, unused);
  }

  /// With its radius, as the same balls are passed by one chain after the other.
  const CurvePoint& centre(int vertex) {
    const auto [at, is_new] = centres_.try_emplace(vertex, Point(balls_.centres.row(vertex)));
    if (is_new) (void)at->second.radius(tree_);
    return at->second;
  }

  /// A point of the vertex' ball close to the vertex.
  CurvePoint under(int vertex) const {
    constexpr double share = 0.02;  // of the radius
    const Point top = working_.place(vertex);
    return Point(top + share * (Point(balls_.centres.row(vertex)) - top));
  }

  bool leaves(const std::vector<CurvePoint>& way) const {
    const auto hidden = [&](const CurvePoint& p, const CurvePoint& q) { return !sees(p, q); };
    return std::adjacent_find(way.begin(), way.end(), hidden) != way.end();
  }

  /// From below a vertex to where its steps begin, by the first of its triangles whose corner there
  /// is seen, and from that one round the vertex. Empty if none is.
  std::vector<CurvePoint> way_down(int vertex) {
    const Point top = working_.place(vertex);
    const CurvePoint start = under(vertex);
    if (start.radius(tree_) <= 0) return {};  // nothing is seen from outside
    const auto around = below().around(vertex);
    for (std::size_t k = 0; k < around.size(); k += 2) {
      const double share = (start.place() - top).norm() / (around[k] - top).norm();
      const CurvePoint corner = Point(top + std::min(share, 1.0) * (around[k] - top));
      if (!sees(start, corner) || !sees(corner, around[k])) continue;
      std::vector<CurvePoint> way{start, corner};
      for (std::size_t i = k + 1; i-- > 0;) way.emplace_back(around[i]);
      return way;
    }
    return {};
  }

  /// From one ball to that of a neighbour: to the surface, along below it, and up again. Empty
  /// where the surface meets itself and that leads outside.
  std::vector<CurvePoint> way_below(int from, int to) {
    std::vector<CurvePoint> way = short_way_below(from, to);
    if (!way.empty()) return way;
    way = way_down(from);
    auto up = way_down(to);
    if (way.empty() || up.empty()) return {};
    std::reverse(up.begin(), up.end());
    const auto step = below().step(from, to);
    way.insert(way.end(), step.begin() + 1, step.end());
    way.insert(way.end(), up.begin() + 1, up.end());
    return leaves(way) ? std::vector<CurvePoint>{} : way;
  }

  /// The same, if the way below the vertices is seen from them.
  std::vector<CurvePoint> short_way_below(int from, int to) {
    const CurvePoint first = under(from);
    const CurvePoint last = under(to);
    if (first.radius(tree_) <= 0 || last.radius(tree_) <= 0) return {};
    const std::vector<Point> step = below().step(from, to);
    std::vector<CurvePoint> way(step.begin(), step.end());
    // One-rings need not be seen as a whole from below their vertex.
    const auto from_first = [&](const CurvePoint& q) { return sees(first, q); };
    const auto from_last = [&](const CurvePoint& q) { return sees(q, last); };
    way.erase(way.begin(), std::find_if(way.begin(), way.end(), from_first));
    way.erase(std::find_if(way.rbegin(), way.rend(), from_last).base(), way.end());
    if (way.empty()) return {};
    way.insert(way.begin(), first);
    way.push_back(last);
    return leaves(way) ? std::vector<CurvePoint>{} : way;
  }

  /// The vertices of a chain of balls. The ball that holds an end best may not be seen from it;
  /// the chain then goes on to the ball whose centre is nearest.
  std::vector<int> balls_between(const CurvePoint& p, const CurvePoint& q,
                                 const std::vector<int>& groups) {
    std::vector<int> vertices = chains_.way_between(p.place(), q.place(), groups);
    if (vertices.empty()) return {};
    if (!sees(p, centre(vertices.front()))) {
      auto way = chains_.way(chains_.nearest_vertex(p.place(), groups), vertices.front(), groups);
      if (!way.empty()) vertices.insert(vertices.begin(), way.begin(), way.end() - 1);
    }
    if (!sees(centre(vertices.back()), q)) {
      const auto way =
          chains_.way(vertices.back(), chains_.nearest_vertex(q.place(), groups), groups);
      if (!way.empty()) vertices.insert(vertices.end(), way.begin() + 1, way.end());
    }
    return vertices;
  }

  /// The balls that have to come between those of two neighbours.
  struct BallStep {
    bool is_hidden = false;
    std::vector<CurvePoint> between;
  };

  const BallStep& ball_step(int from, int to) {
    const auto [at, is_new] = ball_steps_.try_emplace({from, to});
    if (is_new && !sees(centre(from), centre(to))) {
      if (more_fruitless_ways_ > 0) at->second.between = way_below(from, to);
      at->second.is_hidden = at->second.between.empty();
      if (at->second.is_hidden) --more_fruitless_ways_;
    }
    return at->second;
  }

  struct Detour {
    std::vector<CurvePoint> points;
    int uncovered = 0;
    std::vector<std::pair<int, int>> hidden;  ///< steps between two balls
  };

  /// From ball to ball, but just below the surface where no way between two of them is found.
  Detour detour_by(const std::vector<int>& vertices, const CurvePoint& p, const CurvePoint& q) {
    Detour made;
    std::vector<CurvePoint> chain{p};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i > 0) {
        const BallStep& step = ball_step(vertices[i - 1], vertices[i]);
        if (step.is_hidden) made.hidden.emplace_back(vertices[i - 1], vertices[i]);
        chain.insert(chain.end(), step.between.begin(), step.between.end());
      }
      chain.push_back(centre(vertices[i]));
    }
    chain.push_back(q);
    chain = shortcut(chain, tree_);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      if (i > 0) made.points.push_back(chain[i]);
      const CoveredStep& step = covered_step(chain[i], chain[i + 1]);
      if (!step.is_covered) ++made.uncovered;
      made.points.insert(made.points.end(), step.between.begin(), step.between.end());
    }
    return made;
  }

  /// The points that have to come between two.
  struct CoveredStep {
    bool is_covered = false;
    std::vector<CurvePoint> between;
  };

  /// Known from then on, as a detour differs from the last in a few of its steps.
  const CoveredStep& covered_step(const CurvePoint& p, const CurvePoint& q) {
    const auto [at, is_new] = covered_steps_.try_emplace(
        {p.place().x(), p.place().y(), p.place().z(), q.place().x(), q.place().y(), q.place().z()});
    if (is_new) at->second.is_covered = is_covered(p, q, at->second.between);
    return at->second;
  }

  /// The way between two points; round the steps that lead outside, if the surface meets itself.
  /// Nothing if the groups have no chain.
  std::optional<Detour> round_hidden_steps(const CurvePoint& p, const CurvePoint& q,
                                           const std::vector<int>& groups) {
    std::optional<Detour> best;
    while (true) {
      throw_if_stopped(options_.stop);
      const auto vertices = balls_between(p, q, groups);
      if (vertices.empty()) break;
      Detour made = detour_by(vertices, p, q);
      for (const auto& [one, other] : made.hidden) chains_.avoid(one, other);
      const bool is_last = made.uncovered == 0 || made.hidden.empty() || more_tries_ == 0;
      if (!best || made.uncovered < best->uncovered) best = std::move(made);
      if (is_last) break;
      --more_tries_;
    }
    chains_.allow_all();
    return best;
  }

  Stretch detour(const Arc& arc, const std::vector<CurvePoint>& line, std::size_t first,
                 std::size_t last) {
    ++detours_;
    auto made = round_hidden_steps(line[first], line[last], groups_along(graph_, arc, partition_));
    if (!made) return {last, {}, 1};
    return {last, std::move(made->points), made->uncovered};
  }

  /// Made when first asked for, as there is mostly another way.
  const BelowSurface& below() {
    if (!below_) below_.emplace(working_);
    return *below_;
  }

  SkeletonGraph& graph_;
  const WorkingSurface& working_;
  const InscribedBalls& balls_;
  const PartitionGraph& partition_;
  const SurfaceTree& tree_;
  HomologyGuard& handles_;
  const InsideOptions& options_;
  std::optional<BelowSurface> below_;
  std::optional<WaysBelow> ways_below_;
  BallChains chains_;
  std::map<int, CurvePoint> centres_;                   ///< of the balls passed so far
  std::map<std::pair<int, int>, BallStep> ball_steps_;  ///< of the steps taken so far
  std::map<std::array<double, 6>, CoveredStep> covered_steps_;
  int uncovered_ = 0;
  bool misses_handle_ = false;  ///< whichever way it goes below the surface
  int detours_ = 0;             ///< of the arc at hand
  // For all detours, as a surface may meet itself everywhere.
  int more_tries_ = 300;
  int more_fruitless_ways_ = 300;  ///< below the surface, from ball to ball
};

}  // namespace

int keep_inside(SkeletonGraph& graph, const WorkingSurface& working,
                const PartitionGraph& partition, const SurfaceTree& tree, HomologyGuard& handles,
                const InsideOptions& options) {
  return Keeper(graph, working, partition, tree, handles, options).run();
}

}  // namespace curveskel
