#include "surface/mesh/crosses_itself.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

#include <curveskel/advanced/tree.hpp>
#include "surface/mesh/cgal_mesh.hpp"

namespace curveskel {

bool crosses_itself(const Surface& surface) {
  using CrossingPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto mesh = cgal_mesh<CGAL::Surface_mesh<CrossingPoint>>(surface);
  return CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
}

double crossing_share(const Surface& surface) {
  constexpr Eigen::Index most_edges = 2000;
  constexpr double ends = 1e-3;  // of the edge, left out at either end
  const SurfaceTree tree(surface);
  const Triangles& corners = surface.triangles;
  const Eigen::Index step = std::max<Eigen::Index>(1, corners.rows() / most_edges);
  int asked = 0;
  int crossing = 0;
  for (Eigen::Index f = 0; f < corners.rows(); f += step) {
    const auto k = static_cast<int>(f / step % 3);
    const int from = corners(f, k);
    const int to = corners(f, (k + 1) % 3);
    const Eigen::Vector3d begin = surface.positions.row(from);
    const Eigen::Vector3d way = surface.positions.row(to).transpose() - begin;
    const double length = way.norm();
    if (!(length > 0)) continue;
    ++asked;
    const auto hit = tree.ray(begin + ends * way, way / length, (1 - 2 * ends) * length);
    if (hit.triangle < 0) continue;
    const auto met = corners.row(hit.triangle);
    const bool is_own = std::any_of(met.begin(), met.end(),
                                    [&](int corner) { return corner == from || corner == to; });
    crossing += is_own ? 0 : 1;
  }
  return asked == 0 ? 0 : static_cast<double>(crossing) / asked;
}

}  // namespace curveskel
