#include "skeleton/embed/place/settle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "base/parallel.hpp"
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/place/axes.hpp"
#include "skeleton/embed/place/cross_section.hpp"

namespace curveskel {
namespace {

/// The cross-section that a point had when it was last taken.
struct SectionSeen {
  Point from = Point::Zero();
  Point along = Point::Zero();
  CrossSection section{Point::Zero(), 0};
  bool known = false;
};

class Settling {
 public:
  Settling(SkeletonGraph& graph, const SurfaceTree& tree, const SettleOptions& options,
           HomologyGuard& guard, int threads)
      : graph_(graph),
        tree_(tree),
        options_(options),
        guard_(guard),
        threads_(threads),
        headings_(tip_headings(graph, tree, options.tuning)),
        seen_(graph.arcs.size()) {
    for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
      if (graph.arcs[s].alive) seen_[s].resize(graph.arcs[s].points.size());
    }
    for (const Node& node : graph.nodes) {
      first_radius_.push_back(node.alive ? node.point.radius(tree) : 0);
    }
  }

  void round() {
    turn_closed_arcs();
    const SkeletonGraph before = guard_.has_handles() ? graph_ : SkeletonGraph{};
    const std::vector<Place> places = all_places();
    const auto lines = polylines();
    for_each(places, [&](const Place& at) { look_round(at, lines[at.arc]); });
    const auto goals = goals_of(lines);
    for_each(places, [&](const Place& at) { step(at, goals[at.arc][at.point]); });
    move_junctions();
    centre_tips(graph_, tree_, headings_, options_.tuning);
    for (const int s : guard_.restore_points(before, graph_, tree_)) {
      std::fill(seen_[idx(s)].begin(), seen_[idx(s)].end(), SectionSeen{});
    }
  }

 private:
  struct Place {
    std::size_t arc;
    std::size_t point;
  };

  template <typename Visit>
  void for_each(const std::vector<Place>& places, const Visit& visit) const {
    constexpr std::size_t grain = 16;
    parallel_for(places.size(), grain, threads_, [&](std::size_t begin, std::size_t end) {
      throw_if_stopped(options_.stop);
      for (std::size_t i = begin; i < end; ++i) visit(places[i]);
    });
  }

  void turn_closed_arcs() {
    for (std::size_t s = 0; s < graph_.arcs.size(); ++s) {
      if (!graph_.turn_half_way_round(static_cast<int>(s))) continue;
      auto& seen = seen_[s];
      const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
      std::vector<SectionSeen> turned(middle + 1, seen.end());
      turned.emplace_back();  // of the old node
      turned.insert(turned.end(), seen.begin(), middle);
      seen = std::move(turned);
    }
  }

  [[nodiscard]] std::vector<Place> all_places() const {
    std::vector<Place> places;
    for (std::size_t s = 0; s < graph_.arcs.size(); ++s) {
      if (!graph_.arcs[s].alive) continue;
      for (std::size_t i = 0; i < graph_.arcs[s].points.size(); ++i) places.push_back({s, i});
    }
    return places;
  }

  [[nodiscard]] std::vector<std::vector<Point>> polylines() const {
    std::vector<std::vector<Point>> lines(graph_.arcs.size());
    for (std::size_t s = 0; s < lines.size(); ++s) {
      if (graph_.arcs[s].alive) lines[s] = graph_.polyline(graph_.arcs[s]);
    }
    return lines;
  }

  void look_round(const Place& at, const std::vector<Point>& line) {
    SectionSeen& seen = seen_[at.arc][at.point];
    const Point& here = line[at.point + 1];
    const Point along = (line[at.point + 2] - line[at.point]).normalized();
    const double rest = options_.tuning.section_rest;
    if (seen.known && (here - seen.from).norm() <= rest * seen.section.width &&
        (along - seen.along).norm() <= options_.tuning.section_turn) {
      return;
    }
    const double radius = graph_.arcs[at.arc].points[at.point].radius(tree_);
    const auto is_own = [&](int triangle) {
      return options_.is_own(triangle, static_cast<int>(at.arc));
    };
    seen = {here, along, flat_cross_section(tree_, here, along, radius, is_own, options_.section),
            true};
  }

  /// Where the points of each arc go, in one go.
  [[nodiscard]] std::vector<std::vector<Point>> goals_of(
      const std::vector<std::vector<Point>>& lines) const {
    std::vector<std::vector<Point>> goals(lines.size());
    const auto solve = [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) goals[s] = goals_on(lines[s], seen_[s]);
    };
    parallel_for(lines.size(), 16, threads_, solve);
    return goals;
  }

  /// (1 + b + a) x_i - b x_{i-1} - a x_{i+1} = c_i, where b and a make the second derivative along
  /// the arc from the neighbours' places, in units of half the width (Thomas' algorithm). With the
  /// part of each point that does not hang on the next one, rest_i = 1 - upper_i, nothing is
  /// subtracted: points that coincide make a and b so large that 1 + a + b - b upper would be 0.
  [[nodiscard]] static std::vector<Point> goals_on(const std::vector<Point>& line,
                                                   const std::vector<SectionSeen>& seen) {
    const std::size_t count = seen.size();
    std::vector<Point> goal(count);
    std::vector<double> upper(count);
    double rest = 1;
    for (std::size_t i = 0; i < count; ++i) {
      const Point& here = line[i + 1];
      const double before = (here - line[i]).norm();
      const double after = (line[i + 2] - here).norm();
      const double scale = 0.25 * seen[i].section.width * seen[i].section.width;
      const double b = scale / std::max(before * (before + after), tiny);
      const double a = scale / std::max(after * (before + after), tiny);
      const Point off = here - seen[i].section.centre;
      const Point sum = seen[i].section.centre + seen[i].along * seen[i].along.dot(off) +
                        b * (i == 0 ? line.front() : goal[i - 1]);
      const double own = 1 + b * rest;
      const double diagonal = own + a;
      upper[i] = a / diagonal;
      rest = own / diagonal;
      goal[i] = (i + 1 == count ? Point(sum + a * line.back()) : sum) / diagonal;
    }
    for (std::size_t i = count; i-- > 1;) goal[i - 1] += upper[i - 1] * goal[i];
    return goal;
  }

  /// The whole way to the goal, half of it, or a quarter, as far as the point stays central.
  void step(const Place& at, const Point& goal) {
    CurvePoint& point = graph_.arcs[at.arc].points[at.point];
    const Point here = point.place();
    const double radius = point.radius(tree_);
    for (const double share : {1.0, 0.5, 0.25}) {
      const Point place = here + share * (goal - here);
      if (place == here) return;
      const CurvePoint candidate(place, tree_.inscribed_radius(place, {here, radius}));
      if (candidate.radius(tree_) < options_.keep * radius) continue;
      point = candidate;
      return;
    }
  }

  void move_junctions() {
    for (int h = 0; h < static_cast<int>(graph_.nodes.size()); ++h) {
      Node& node = graph_.nodes[idx(h)];
      if (!node.alive || graph_.degree(h) < 3) continue;
      const Point goal = meeting_of_axes(graph_, h, node.point.radius(tree_), options_.tuning);
      const CurvePoint candidate = Point(0.5 * (node.point.place() + goal));
      if (candidate.radius(tree_) < first_radius_[idx(h)]) continue;
      if (makes_spur(graph_, h, candidate, tree_, options_.tuning)) continue;
      node.point = candidate;
    }
  }

  static constexpr double tiny = 1e-30;  // points that coincide

  SkeletonGraph& graph_;
  const SurfaceTree& tree_;
  const SettleOptions& options_;
  HomologyGuard& guard_;
  int threads_;
  std::vector<TipHeading> headings_;
  std::vector<double> first_radius_;
  std::vector<std::vector<SectionSeen>> seen_;  // per arc, of its inner points
};

}  // namespace

void settle(SkeletonGraph& graph, const SurfaceTree& tree, const SettleOptions& options,
            HomologyGuard& guard, int threads) {
  Settling branches(graph, tree, options, guard, threads);
  for (int round = 0; round < options.rounds; ++round) branches.round();
}

}  // namespace curveskel
