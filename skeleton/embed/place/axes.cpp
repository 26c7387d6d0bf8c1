#include "skeleton/embed/place/axes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

struct Axis {
  Point place = Point::Zero();
  Point direction = Point::Zero();
};

/// At an arc length, or at the end if the line is shorter.
Point point_on(const std::vector<Point>& line, double arc) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (arc <= step && step > 0) return line[i - 1] + arc / step * (line[i] - line[i - 1]);
    arc -= step;
  }
  return line.back();
}

/// The chord between one and three radii along the line; of a shorter line, of its farther part.
Axis axis_of(const std::vector<Point>& line, double length, double radius) {
  const double last = std::clamp(3 * radius, 0.0, length);
  const Point begin = point_on(line, last / 3);
  return {begin, (point_on(line, last) - begin).normalized()};
}

std::vector<Axis> axes_at(const SkeletonGraph& graph, int node, double radius) {
  std::vector<Axis> axes;
  for (const int s : graph.nodes[idx(node)].arcs) {
    const Arc& arc = graph.arcs[idx(s)];
    const double length = graph.length(arc);
    auto line = graph.polyline(arc);
    if (arc.from == node) axes.push_back(axis_of(line, length, radius));
    std::reverse(line.begin(), line.end());
    if (arc.to == node) axes.push_back(axis_of(line, length, radius));
  }
  return axes;
}

/// The inner point or node that follows on a node along one of its arcs.
const Point& next_to(const SkeletonGraph& graph, const Arc& arc, int node) {
  if (arc.from == node) {
    return arc.points.empty() ? graph.place(arc.to) : arc.points.front().place();
  }
  return arc.points.empty() ? graph.place(arc.from) : arc.points.back().place();
}

}  // namespace

Point meeting_of_axes(const SkeletonGraph& graph, int node, double radius,
                      const RelaxTuning& tuning) {
  const Point& here = graph.place(node);
  const auto axes = axes_at(graph, node, radius);
  const double held = tuning.axes_hold * static_cast<double>(axes.size());
  Eigen::Matrix3d sum = held * Eigen::Matrix3d::Identity();
  Point right = held * here;
  for (const Axis& axis : axes) {
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - axis.direction * axis.direction.transpose();
    sum += across;
    right += across * axis.place;
  }
  return sum.ldlt().solve(right);
}

bool makes_spur(const SkeletonGraph& graph, int node, const CurvePoint& to, const SurfaceTree& tree,
                const RelaxTuning& tuning) {
  const CurvePoint& from = graph.nodes[idx(node)].point;
  const auto& arcs = graph.nodes[idx(node)].arcs;
  return std::any_of(arcs.begin(), arcs.end(), [&](int s) {
    const Arc& arc = graph.arcs[idx(s)];
    if (!graph.is_leaf(arc)) return false;
    const Point& next = next_to(graph, arc, node);
    const double before = graph.length(arc);
    const double after = before - (next - from.place()).norm() + (next - to.place()).norm();
    return after < tuning.spur_margin * to.radius(tree) &&
           after * from.radius(tree) < before * to.radius(tree);
  });
}

}  // namespace curveskel
