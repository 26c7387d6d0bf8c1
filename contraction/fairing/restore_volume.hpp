// Undoing the shrinkage of a flow.
#pragma once

#include <vector>

#include <curveskel/fair.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Moves the vertices of each closed component until it encloses the volume that it has with the
/// positions `before`, to within 1e-9 (relative). Components in which some vertex is `held` are
/// left alone, as a surface with a boundary encloses nothing. O(#F).
/// Throws Error(Fault::solver) where no volume is left.
void restore_volume(Surface& surface, const Positions& before, const std::vector<bool>& held,
                    VolumeRule rule);

}  // namespace curveskel
