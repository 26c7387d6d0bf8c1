// Triangles to pixels: the nearest layer, and the thickness behind it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

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

/// The part of the picture that the surface can touch, in pixels.
struct PictureWindow {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Neighbours in a row of the window, from (left, y) of the window on. The row's other pixels are
/// not covered.
struct FragmentRow {
  int left;
  int y;
  std::span<const Fragment> pixels;
};

/// In pixels.
struct PictureSize {
  int width = 0;
  int height = 0;
};

/// The receivers of what `rasterise` finds.
struct FragmentSink {
  std::function<void(const PictureWindow&)> begin;
  std::function<void(const FragmentRow&)> draw;
};

/// Calls begin(window) first, then draw(row) once for each row that the surface touches, from all
/// threads: rows are not kept, as those of a whole picture take longer to store than to make.
/// 3 x 3 samples per pixel; a sample on an edge belongs to one of the two triangles, so that the
/// depths of a closed surface add up to the thickness. The same rows for any number of threads.
/// `normals` are #V by 3. O(#F + samples covered).
void rasterise(const Surface& surface, const Positions& normals, const View& view,
               const PictureSize& size, int threads, const FragmentSink& sink);

}  // namespace curveskel
