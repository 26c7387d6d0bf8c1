// For components that are closed, but cross themselves so that nothing can go round their handles
// or through their limbs.
#pragma once

#include <optional>
#include <vector>

#include "surface/monitor.hpp"
#include "surface/repair.hpp"

namespace curveskel {

/// The surface with wraps in the place of these components (by their numbers in `topology`), each
/// wrapped on its own (see `wrap_solid`; `opening` of the component's own extent). A wrapped vertex
/// has the nearest one of its wrap; openings that were closed there are openings no more. Counted
/// and said in `repairs`. Nothing if one of the wraps encloses no more than its own thickness.
/// Throws Cancelled on a stop.
[[nodiscard]] std::optional<RepairedSurface> wrap_components(const RepairedSurface& repaired,
                                                             const std::vector<int>& components,
                                                             double opening,
                                                             const Monitor& monitor);

}  // namespace curveskel
