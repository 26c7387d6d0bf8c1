#include "surface/mesh/crosses_itself.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "surface/mesh/cgal_mesh.hpp"

namespace curveskel {

bool crosses_itself(const Surface& surface) {
  using CrossingPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto mesh = cgal_mesh<CGAL::Surface_mesh<CrossingPoint>>(surface);
  return CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
}

}  // namespace curveskel
