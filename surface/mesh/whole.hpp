// Most surfaces need no mending; that is found out in a fraction of the time that mending takes.
#pragma once

#include <optional>

#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// The surface's topology if it is whole: closed, every edge run through once either way, every
/// vertex with exactly one umbrella of faces, no face with a repeated corner and no two faces with
/// the same three vertices. Nothing otherwise. O(#V + #F) for bounded valence.
[[nodiscard]] std::optional<Topology> topology_if_whole(const Surface& surface, int threads);

/// The same question without the counts. Precondition: corners are vertices.
[[nodiscard]] bool is_whole(const Surface& surface, int threads);

}  // namespace curveskel
