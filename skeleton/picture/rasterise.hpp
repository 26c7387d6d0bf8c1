// Triangles to pixels: the nearest layer, and the thickness behind it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/surface.hpp>
#include <curveskel/view.hpp>

namespace curveskel {

/// Means over those of a pixel's samples that the surface covers.
struct Fragment {
  float coverage = 0;   ///< share of the samples that are covered
  float depth = 0;      ///< of the front-most point, in pixels towards the viewer
  float thickness = 0;  ///< length of the ray inside the surface, in pixels
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< right, up, towards the viewer
};

/// The part of the picture that the surface can touch, row by row from the top.
struct Fragments {
  int left = 0;  ///< where it begins in the picture, in pixels
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<Fragment> pixels;
};

/// 3 x 3 samples per pixel; a sample on an edge belongs to one of the two triangles, so that the
/// depths of a closed surface add up to the thickness. The same result for any number of threads.
/// `normals` are #V by 3. O(#F + samples covered).
[[nodiscard]] Fragments rasterise(const Surface& surface, const Positions& normals,
                                  const View& view, int width, int height, int threads);

}  // namespace curveskel
