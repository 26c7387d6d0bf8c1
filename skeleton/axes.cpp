#include "skeleton/axes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "surface/element_index.hpp"

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

std::vector<Axis> axes_at(const Network& network, int hub, double radius) {
  std::vector<Axis> axes;
  for (const int s : network.hubs[at(hub)].strands) {
    const Strand& strand = network.strands[at(s)];
    const double length = network.length(strand);
    auto line = network.polyline(strand);
    if (strand.from == hub) axes.push_back(axis_of(line, length, radius));
    std::reverse(line.begin(), line.end());
    if (strand.to == hub) axes.push_back(axis_of(line, length, radius));
  }
  return axes;
}

/// The inner point or hub that follows on a hub along one of its strands.
const Point& next_to(const Network& network, const Strand& strand, int hub) {
  if (strand.from == hub) {
    return strand.points.empty() ? network.hubs[at(strand.to)].position : strand.points.front();
  }
  return strand.points.empty() ? network.hubs[at(strand.from)].position : strand.points.back();
}

}  // namespace

Point meeting_of_axes(const Network& network, int hub, double radius) {
  constexpr double hold = 0.1;
  const Point& here = network.hubs[at(hub)].position;
  const auto axes = axes_at(network, hub, radius);
  const double held = hold * static_cast<double>(axes.size());
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

bool makes_spur(const Network& network, int hub, const SurfaceTree::Ball& from,
                const SurfaceTree::Ball& to) {
  constexpr double margin = 1.05;
  const auto& strands = network.hubs[at(hub)].strands;
  return std::any_of(strands.begin(), strands.end(), [&](int s) {
    const Strand& strand = network.strands[at(s)];
    if (!network.is_leaf(strand)) return false;
    const Point& next = next_to(network, strand, hub);
    const double before = network.length(strand);
    const double after = before - (next - from.centre).norm() + (next - to.centre).norm();
    return after < margin * to.radius && after * from.radius < before * to.radius;
  });
}

}  // namespace curveskel
