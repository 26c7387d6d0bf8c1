// Undoing the shrinkage of a flow.
#pragma once

#include <vector>

#include <curveskel/fair.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// Moves the vertices of each closed component until it encloses the volume that it has with the
/// positions `before`, to within 1e-9 (relative). Left alone are components in which some vertex is
/// `held`, as a surface with a boundary encloses nothing, and those whose volume is rounding alone,
/// below 1e-12. Positions near the origin, each component's with a bounding-box diagonal of about
/// 1; `parts` is the topology of `surface`. O(#F).
/// Returns per component: true if it is too coarse for the flow, which has left less than a tenth
/// of its volume or more than twice as much, or if its volume cannot be restored without half as
/// much area again. The positions of such a component are good for nothing.
[[nodiscard]] std::vector<bool> restore_volume(Surface& surface, const Topology& parts,
                                               const Positions& before,
                                               const std::vector<bool>& held, VolumeRule rule);

}  // namespace curveskel
