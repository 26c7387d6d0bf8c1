// Edges along which a surface does not bend.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// Share of the edges whose two faces turn by less than .01 degrees from one to the other:
/// next to nothing of a scan or of a sculpture, a third and more of what was drawn with plane
/// sides. 0 without edges; a face without area is flat to none. O(#F). Precondition: as for
/// pair_half_edges.
[[nodiscard]] double share_of_flat_edges(const Surface& surface);

}  // namespace curveskel
