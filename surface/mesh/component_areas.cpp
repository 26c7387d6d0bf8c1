#include "surface/mesh/component_areas.hpp"

#include <Eigen/Geometry>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

std::vector<double> component_areas(const Surface& surface, const Topology& counted) {
  std::vector<double> areas(idx(counted.components()), 0);
  for (const auto& t : surface.triangles.rowwise()) {
    const Eigen::RowVector3d a = surface.positions.row(t(0));
    const Eigen::RowVector3d ab = surface.positions.row(t(1)) - a;
    const Eigen::RowVector3d ac = surface.positions.row(t(2)) - a;
    areas[idx(counted.component_of_vertex[t(0)])] += ab.cross(ac).norm() / 2;
  }
  return areas;
}

}  // namespace curveskel
