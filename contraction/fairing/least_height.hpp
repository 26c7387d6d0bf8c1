// The faces that have an area, for every method of the local flow and its kernels alike.
#pragma once

#include <algorithm>
#include <string_view>

namespace curveskel {

/// A face that is no higher than this over its longest side counts as without area; in a unit box,
/// as of ComponentBoxes. Below lies the rounding of positions in single precision, which gives such
/// a face any cotangents, in each method others.
inline constexpr double least_height = 0x1p-23;

/// The same for kernels.
inline constexpr std::string_view least_height_option = " -DLEAST_HEIGHT=0x1p-23f";

/// Products of two sides of a face, first and second, and its third, edge = second - first.
struct SideProducts {
  double first_second, first_edge, second_edge;
};

/// `square` is that of the doubled area.
[[nodiscard]] inline bool has_area(double square, const SideProducts& of) {
  const double longest =
      std::max({of.first_second - of.first_edge, of.first_second + of.second_edge,
                of.second_edge - of.first_edge});
  return square > least_height * least_height * longest;
}

}  // namespace curveskel
