#include <curveskel/advanced/laplacian.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include "contraction/laplacian/assemble.hpp"
#include "contraction/laplacian/intrinsic_delaunay.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {

SparseMatrix cotangent_laplacian(const Surface& surface) {
  require_sound(surface, "cotangent_laplacian");
  std::vector<WeightedEdge> edges;
  edges.reserve(surface.triangles.size());
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int apex = surface.triangles(f, k);
      const int i = surface.triangles(f, (k + 1) % 3);
      const int j = surface.triangles(f, (k + 2) % 3);
      const Eigen::Vector3d u = surface.positions.row(i) - surface.positions.row(apex);
      const Eigen::Vector3d v = surface.positions.row(j) - surface.positions.row(apex);
      // A triangle without area has no cotangents; it adds nothing rather than infinity.
      const double double_area = u.cross(v).norm();
      if (double_area > 0) edges.push_back({i, j, 0.5 * u.dot(v) / double_area});
    }
  }
  SparseMatrix laplacian;
  LaplacianAssembly().assemble(edges, static_cast<int>(surface.positions.rows()), laplacian);
  return laplacian;
}

SparseMatrix intrinsic_delaunay_laplacian(const Surface& surface, double mollify,
                                          double max_weight) {
  require_sound(surface, "intrinsic_delaunay_laplacian");
  const int vertices = static_cast<int>(surface.positions.rows());
  IntrinsicDelaunay triangulation;
  SparseMatrix laplacian;
  LaplacianAssembly().assemble(triangulation.weights(CollapsibleMesh(surface.triangles, vertices),
                                                     surface.positions, mollify, max_weight),
                               vertices, laplacian);
  return laplacian;
}

Eigen::VectorXd vertex_areas(const Surface& surface) {
  require_sound(surface, "vertex_areas");
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.positions.rows());
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const double third = twice_area(surface, f) / 6;
    for (const int vertex : surface.triangles.row(f)) areas[vertex] += third;
  }
  return areas;
}

}  // namespace curveskel
