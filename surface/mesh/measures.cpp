#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>

#include <Eigen/Geometry>
#include <cmath>

#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

// Rows of a row-major matrix as column vectors, which Eigen's geometry functions want.
Eigen::Vector3d point(const Surface& surface, Eigen::Index face, int corner) {
  return surface.positions.row(surface.triangles(face, corner)).transpose();
}

}  // namespace

double area(const Surface& surface) {
  require_corners(surface, "area");
  double twice = 0;
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    twice += twice_area(surface, face);
  }
  return twice / 2;
}

double volume(const Surface& surface) {
  require_corners(surface, "volume");
  if (surface.positions.rows() == 0) return 0;
  const Eigen::Vector3d origin = surface.positions.row(0).transpose();
  double six_fold = 0;
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const Eigen::Vector3d a = point(surface, face, 0) - origin;
    const Eigen::Vector3d b = point(surface, face, 1) - origin;
    const Eigen::Vector3d c = point(surface, face, 2) - origin;
    six_fold += a.dot(b.cross(c));
  }
  return six_fold / 6;
}

double bounding_box_diagonal(const Positions& positions) {
  if (positions.rows() == 0) return 0;
  const Eigen::RowVector3d extent = positions.colwise().maxCoeff() - positions.colwise().minCoeff();
  const double largest = extent.maxCoeff();
  // Squares of such lengths are no numbers, or have lost their digits.
  const bool squared = largest > 1e-140 && largest < 1e150;
  return squared || !(largest > 0) ? extent.norm() : largest * (extent / largest).norm();
}

Positions vertex_normals(const Surface& surface) {
  require_corners(surface, "vertex_normals");
  Positions normals = Positions::Zero(surface.positions.rows(), 3);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const Eigen::Vector3d a = point(surface, face, 0);
    const Eigen::Vector3d b = point(surface, face, 1);
    const Eigen::Vector3d c = point(surface, face, 2);
    const Eigen::Vector3d ab = b - a;
    const Eigen::Vector3d bc = c - b;
    const Eigen::Vector3d ca = a - c;
    const Eigen::Vector3d cross = ab.cross(-ca);
    const double twice_area = cross.norm();
    if (!(twice_area > 0)) continue;
    const Eigen::RowVector3d normal = cross.transpose() / twice_area;
    // The three angles share one cross product.
    const double at_a = std::atan2(twice_area, -ab.dot(ca));
    const double at_b = std::atan2(twice_area, -bc.dot(ab));
    const double at_c = std::atan2(twice_area, -ca.dot(bc));
    normals.row(surface.triangles(face, 0)) += at_a * normal;
    normals.row(surface.triangles(face, 1)) += at_b * normal;
    normals.row(surface.triangles(face, 2)) += at_c * normal;
  }
  for (Eigen::Index vertex = 0; vertex < normals.rows(); ++vertex) {
    const double length = normals.row(vertex).norm();
    if (length > 0) normals.row(vertex) /= length;
  }
  return normals;
}

}  // namespace curveskel
