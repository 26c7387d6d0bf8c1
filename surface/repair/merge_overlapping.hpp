// One body made of components that overlap.
#pragma once

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

/// Components that meet (cross or touch) become their union (see `unite`), in the place of the
/// first; those wholly inside another are left out. A vertex of the file that is no vertex of the
/// new surface has the nearest one of its body; the rims of holes stay where all their vertices do.
/// Noted in `result.repairs.merging`. Throws Cancelled on a stop.
void merge_overlapping(RepairedSurface& result, const Monitor& monitor);

}  // namespace curveskel
