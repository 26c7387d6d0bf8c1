// The region in which a plane cuts a solid, around a point of that plane.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A polygon in the plane.
struct SectionLoop {
  Eigen::Matrix2Xd corners;    ///< relative to the section's origin along its two axes
  std::vector<int> triangles;  ///< of the surface: the one that holds the side from each corner
};

struct PlaneSection {
  Eigen::Vector3d origin;
  Eigen::Matrix<double, 3, 2> axes;   ///< orthonormal; with the normal right-handed
  std::vector<SectionLoop> boundary;  ///< the outer loop, counter-clockwise, then the holes
};

/// Nothing if the point lies outside of the surface. `normal` is a unit vector. Precondition: the
/// tree is that of the surface, which is closed and oriented. A plane through a vertex is taken as
/// one just beside it. Linear in the triangles crossed, but for the sorting of these.
[[nodiscard]] std::optional<PlaneSection> section_around(const Surface& surface,
                                                         const SurfaceTree& tree,
                                                         const Eigen::Vector3d& point,
                                                         const Eigen::Vector3d& normal);

/// Of a point of the plane. Linear in the section's corners.
[[nodiscard]] bool contains(const PlaneSection& section, const Eigen::Vector3d& point);

struct SectionMeasures {
  double area = 0;
  double perimeter = 0;            ///< of all loops
  Eigen::Matrix2d second_moments;  ///< integral of x x' about the centroid
};
[[nodiscard]] SectionMeasures measure(const PlaneSection& section);

}  // namespace curveskel
