// Pictures of a skeleton inside its surface, drawn by a small software renderer.
#pragma once

#include <Eigen/Core>
#include <string>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct PictureOptions {
  int width = 1600;   ///< pixels
  int height = 1200;  ///< pixels
  int threads = 0;    ///< 0 = one per core; the picture does not depend on it
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< as of `best_views`
};

/// The bytes of a PNG file: the surface half transparent, the skeleton in it, seen so that most of
/// it shows. Preconditions: the surface has at least one triangle; finite coordinates.
/// O(#F + pixels); memory for each pixel of the image: 3 bytes, and 6 where the surface is.
[[nodiscard]] std::string png_picture(const CurveSkeleton& skeleton, const Surface& surface,
                                      const PictureOptions& options);

/// The same view as SVG: the surface as an embedded PNG, the skeleton as lines and cut curves.
[[nodiscard]] std::string svg_picture(const CurveSkeleton& skeleton, const Surface& surface,
                                      const PictureOptions& options);

}  // namespace curveskel
