#include "skeleton/embed/place/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {
namespace {

/// Points along a polyline, half of the radius there apart, ends left out; `radii` per vertex.
std::vector<CurvePoint> spaced(const std::vector<Point>& line, const std::vector<double>& radii,
                               const Spacing& spacing, int fewest) {
  std::vector<double> steps{0};  // from the beginning
  steps.reserve(line.size());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = std::clamp(0.25 * (radii[i - 1] + radii[i]), spacing.least, spacing.most);
    steps.push_back(steps.back() + (line[i] - line[i - 1]).norm() / step);
  }
  const int inner = std::max(fewest, static_cast<int>(std::lround(steps.back())) - 1);
  std::vector<CurvePoint> points;
  points.reserve(idx(inner));
  std::size_t i = 1;
  for (int k = 1; k <= inner; ++k) {
    const double place = steps.back() * k / (inner + 1);
    while (i + 1 < line.size() && steps[i] < place) ++i;
    const double length = steps[i] - steps[i - 1];
    const double t = length > 0 ? (place - steps[i - 1]) / length : 0;
    points.emplace_back(line[i - 1] + t * (line[i] - line[i - 1]));
  }
  return points;
}

int fewest_points(const Arc& arc) { return arc.from == arc.to ? 3 : 1; }

/// The points of a curve that tell its course (Ramer, Douglas and Peucker).
class StraightRuns {
 public:
  StraightRuns(const std::vector<CurvePoint>& line, const SurfaceTree& tree, const Spacing& spacing,
               const SpacingTuning& tuning)
      : line_(line), tree_(tree), spacing_(spacing), tuning_(tuning), kept_(line.size(), 0) {
    kept_.front() = kept_.back() = 1;
    split(0, line.size() - 1);
  }

  /// Per point.
  [[nodiscard]] const std::vector<char>& kept() const { return kept_; }

 private:
  void split(std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    double worst = 0;
    std::size_t at = first;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double bend = bend_at(k, first, last);
      if (bend <= worst) continue;
      worst = bend;
      at = k;
    }
    const Point& from = line_[first].place();
    const Point& to = line_[last].place();
    if (worst <= 1) {
      if ((to - from).norm() <= spacing_.straight && !crosses(tree_, from, to)) return;
      at = middle(first, last);
    }
    kept_[at] = 1;
    split(first, at);
    split(at, last);
  }

  /// How far place and radius are from the chord's, over what counts as straight.
  [[nodiscard]] double bend_at(std::size_t k, std::size_t first, std::size_t last) const {
    const Point& from = line_[first].place();
    const Point chord = line_[last].place() - from;
    const Point way = line_[k].place() - from;
    const double squared = chord.squaredNorm();
    const double share = squared > 0 ? std::clamp(way.dot(chord) / squared, 0.0, 1.0) : 0;
    const double radius = line_[k].radius(tree_);
    const double on_chord =
        (1 - share) * line_[first].radius(tree_) + share * line_[last].radius(tree_);
    const double off = std::max((way - share * chord).norm(), std::abs(radius - on_chord));
    return off / std::max(tuning_.bend * radius, tuning_.least_bend);
  }

  /// The point nearest to the middle of the way.
  [[nodiscard]] std::size_t middle(std::size_t first, std::size_t last) const {
    const auto nearer = [&](std::size_t k) {
      return std::abs((line_[k].place() - line_[first].place()).norm() -
                      (line_[k].place() - line_[last].place()).norm());
    };
    std::size_t best = first + 1;
    for (std::size_t k = best + 1; k < last; ++k) {
      if (nearer(k) < nearer(best)) best = k;
    }
    return best;
  }

  const std::vector<CurvePoint>& line_;
  const SurfaceTree& tree_;
  const Spacing& spacing_;
  const SpacingTuning& tuning_;
  std::vector<char> kept_;
};

}  // namespace

Spacing spacing_on(const Surface& surface, const SpacingTuning& tuning) {
  double sum = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      sum += (surface.positions.row(t(k)) - surface.positions.row(t((k + 1) % 3))).norm();
    }
  }
  const auto edges = static_cast<double>(surface.triangles.size());
  return {tuning.least, std::max(tuning.most, tuning.of_edge * sum / edges), tuning.straight};
}

void space_evenly(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    auto radii = graph.radii_along(arc, tree);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    radii.assign(line.size(), *middle);
    arc.points = spaced(line, radii, spacing, fewest_points(arc));
  }
}

void space_by_radius(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    arc.points = spaced(line, graph.radii_along(arc, tree), spacing, fewest_points(arc));
  }
}

void thin_out(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    const auto radius = graph.radii_along(arc, tree);
    std::vector<CurvePoint> kept;
    std::size_t last = 0;
    const std::size_t least = arc.from == arc.to ? 2 : 1;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const double gap = (line[i + 1] - line[last]).norm();
      const bool enough = kept.size() + (line.size() - 2 - i) >= least;
      if (enough && gap <= std::clamp(0.5 * radius[i], spacing.least, spacing.most) &&
          (gap <= radius[last] + radius[i + 1] || !crosses(tree, line[last], line[i + 1]))) {
        continue;
      }
      kept.push_back(arc.points[i - 1]);
      last = i;
    }
    arc.points = std::move(kept);
  }
}

void thin_straight_runs(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing,
                        const SpacingTuning& tuning) {
  for (Arc& arc : graph.arcs) {
    const std::size_t least = arc.from == arc.to ? 2 : 1;
    if (!arc.alive || arc.points.size() <= least) continue;
    const auto line = graph.points_along(arc, tree);
    const StraightRuns runs(line, tree, spacing, tuning);
    std::vector<CurvePoint> kept;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (runs.kept()[i] != 0) kept.push_back(line[i]);
    }
    if (kept.size() < least) {
      kept.clear();
      for (std::size_t k = 1; k <= least; ++k) {
        kept.push_back(line[k * (line.size() - 1) / (least + 1)]);
      }
    }
    arc.points = std::move(kept);
  }
}

void cut_detours(SkeletonGraph& graph, const SurfaceTree& tree, const RelaxTuning& tuning) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive || arc.from == arc.to || arc.points.size() < 2) continue;
    const auto line = graph.polyline(arc);
    const auto radii = graph.radii_along(arc, tree);
    std::vector<CurvePoint> kept;
    std::size_t here = 0;
    while (here + 1 < line.size()) {
      std::size_t next = here + 1;
      double length = (line[next] - line[here]).norm();
      for (std::size_t there = here + 2; there < line.size(); ++there) {
        length += (line[there] - line[there - 1]).norm();
        if (length > 4 * std::max(radii[here], 0.0)) break;
        const double chord = (line[there] - line[here]).norm();
        const bool in_both = chord < tuning.detour_reach * std::min(radii[here], radii[there]);
        if (in_both && length > tuning.detour_length * chord) next = there;
      }
      here = next;
      if (here + 1 < line.size()) kept.push_back(arc.points[here - 1]);
    }
    arc.points = std::move(kept);
  }
}

namespace {

/// By midpoints, until there are so many.
void add_inner_points(const SkeletonGraph& graph, Arc& arc, std::size_t least) {
  while (arc.points.size() < least) {
    const auto line = graph.polyline(arc);
    std::vector<CurvePoint> points;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (i > 0) points.push_back(arc.points[i - 1]);
      points.emplace_back(0.5 * (line[i] + line[i + 1]));
    }
    arc.points = std::move(points);
  }
}

}  // namespace

void keep_simple(SkeletonGraph& graph) {
  for (Arc& arc : graph.arcs) {
    if (arc.alive) add_inner_points(graph, arc, arc.from == arc.to ? 2 : 1);
  }
}

void tell_twins_apart(SkeletonGraph& graph) {
  std::set<std::pair<int, int>> bare;  // between these nodes there is an arc without points
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    if (arc.from == arc.to) add_inner_points(graph, arc, 2);
    if (!arc.points.empty()) continue;
    const bool is_first = bare.insert(std::minmax(arc.from, arc.to)).second;
    if (!is_first) add_inner_points(graph, arc, 1);
  }
}

}  // namespace curveskel
