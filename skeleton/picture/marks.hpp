// The skeleton as a pen would draw it: strokes and dots, back to front.
#pragma once

#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/view.hpp>
#include "skeleton/picture/image.hpp"

namespace curveskel {

/// A straight stroke with round ends (a dot where both ends are one point), in pixels.
struct Mark {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double from_width = 0;  ///< diameter
  double to_width = 0;
  Colour colour;
  bool flat_ends = false;  ///< cut straight at `from` and `to`
};

/// In the order in which to draw them. Each stroke has a light casing, so that the nearer of two
/// branches that cross is seen to pass in front; nearer is also wider and deeper in colour.
/// Junctions and tips are dots. `unit` scales all widths (1 = for 1600 x 1200 pixels).
[[nodiscard]] std::vector<Mark> marks_of(const CurveSkeleton& skeleton, const View& view,
                                         double unit);

/// Draws them with exact edges (coverage by distance).
void draw_marks(const std::vector<Mark>& marks, Image& image);

}  // namespace curveskel
