#include "rig/plan/posed_legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/human_proportions.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

double length_of(const Course& course) {
  double length = 0;
  for (std::size_t k = 1; k < course.points.size(); ++k) {
    length += (course.points[k] - course.points[k - 1]).norm();
  }
  return length;
}

/// Of one side.
double ankle_of(const Course& course, const std::vector<Vector3d>& surface, double hip) {
  const std::size_t last = course.points.size() - 1;
  const double step = 1 / static_cast<double>(last);
  const auto below_hip = [&](double share) {
    return static_cast<std::size_t>(std::lround((hip + share * (1 - hip)) / step));
  };
  const Vector3d shin = course.points[below_hip(0.8)] - course.points[below_hip(0.55)];
  const Vector3d down = shin.normalized();
  double sole = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : surface) sole = std::max(sole, p.dot(down));
  const double length = length_of(course);
  for (std::size_t k = below_hip(0.6); k < last; ++k) {
    const double share = static_cast<double>(k) * step;
    const double above = sole - course.points[k].dot(down);
    if (above <= ankle_of_hips * ((share - hip) * length + above)) return share;
  }
  return 1;
}

}  // namespace

std::vector<Vector3d> surface_of_side(const CurveTree& tree, const Limbs& limbs, const LimbWay& way,
                                      bool is_left) {
  const std::vector<char> is_own = nodes_of_side(tree, limbs, is_left ? way.path : way.mirror);
  std::vector<Vector3d> surface;
  for (std::size_t v = 0; v < tree.vertices.size(); ++v) {
    const int node = tree.node_of_vertex[v];
    if (node < 0 || is_own[idx(node)] == 0) continue;
    surface.push_back(tree.vertices[v]);
    if (!is_left) surface.back().x() = 2 * tree.middle - surface.back().x();
  }
  return surface;
}

double ankle_in_pose(const CurveTree& tree, const Limbs& limbs, const LimbWay& way, double hip) {
  double share = 0;
  for (const bool is_left : {true, false}) {
    share += 0.5 * ankle_of(side_course(tree, way, is_left),
                            surface_of_side(tree, limbs, way, is_left), hip);
  }
  return share;
}

}  // namespace curveskel
