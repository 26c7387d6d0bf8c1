#include "surface/mesh/component_areas.hpp"

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {

std::vector<double> component_areas(const Surface& surface, const Topology& counted) {
  std::vector<double> areas(idx(counted.components()), 0);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const int vertex = surface.triangles(face, 0);
    areas[idx(counted.component_of_vertex[vertex])] += twice_area(surface, face) / 2;
  }
  return areas;
}

}  // namespace curveskel
