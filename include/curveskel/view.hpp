// The point from which a picture looks at a shape.
#pragma once

#include <Eigen/Core>
#include <array>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A parallel projection: model units to pixels (x to the right, y down, z towards the viewer).
struct View {
  Eigen::Matrix3d axes;    ///< rows: right, up, towards the viewer; orthonormal, right-handed
  Eigen::Vector3d target;  ///< the point of the model that appears at `centre`
  Eigen::Vector2d centre;  ///< pixels
  double pixels_per_unit = 1;

  [[nodiscard]] Eigen::Vector3d project(const Eigen::RowVector3d& point) const {
    const Eigen::Vector3d seen = axes * (point.transpose() - target) * pixels_per_unit;
    return {centre.x() + seen.x(), centre.y() - seen.y(), seen.z()};
  }
};

/// Two views at one scale that fill a picture of width x height pixels: the first along the axis of
/// least extent, the second from 90 degrees around, beside or below the first, whichever lets both
/// be larger. `up`, of length 1, is what the file says; where it is y or z, it points up. Else a
/// shape that stands straight in its coordinate frame keeps its up, which is y or z, the one on
/// which it stands more broadly; one that does not is turned to its principal axes. Throws
/// Error(Fault::usage) for a picture without pixels, Error(Fault::input) for places that are not
/// finite. O(#V + #F).
[[nodiscard]] std::array<View, 2> best_views(const Surface& surface, int width, int height,
                                             const Eigen::Vector3d& up = Eigen::Vector3d::Zero());
/// The same of a skeleton alone, whose principal axes are those of its length. O(#N + #E).
[[nodiscard]] std::array<View, 2> best_views(const CurveSkeleton& skeleton, int width, int height);

}  // namespace curveskel
