// Sheets as thin bodies: a wing or an ear of one layer of triangles, which an animator bends all
// the same.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>
#include "surface/repair/bodies_and_sheets.hpp"
#include "surface/repair/close_surface.hpp"

namespace curveskel {

struct ThickSheets {
  Surface surface;                   ///< closed and outward, one component for each sheet
  std::vector<std::int32_t> number;  ///< #V of the closed parts: in `surface`, -1 = in none
  std::vector<std::int32_t> firsts;  ///< a vertex of each sheet, in `surface`
};

/// Gives each part that is no body, and whose box has a diagonal of `least_extent` or more, a
/// second side: both lie a hundredth of the square root of its area from the faces given, which
/// keeps their corners apart and is thin for whatever length. Parts without a boundary, with
/// several boundaries at one vertex, or with a vertex whose faces cancel out have none. O(#F log
/// #F).
[[nodiscard]] ThickSheets thicken(const ClosedParts& closed, const JudgedParts& judged,
                                  double least_extent);

}  // namespace curveskel
