#include "surface/mesh/crosses_itself.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>

namespace curveskel {

bool crosses_itself(const Surface& surface) {
  using CrossingPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  CGAL::Surface_mesh<CrossingPoint> mesh;
  using Vertex = CGAL::Surface_mesh<CrossingPoint>::Vertex_index;
  for (const auto& p : surface.positions.rowwise()) {
    mesh.add_vertex(CrossingPoint(p.x(), p.y(), p.z()));
  }
  const auto vertex = [](std::int32_t v) { return Vertex(static_cast<std::uint32_t>(v)); };
  for (const auto& t : surface.triangles.rowwise()) {
    mesh.add_face(vertex(t(0)), vertex(t(1)), vertex(t(2)));
  }
  return CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
}

}  // namespace curveskel
