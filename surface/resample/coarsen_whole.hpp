// Coarsening of what is known to be whole.
#pragma once

#include <curveskel/advanced/coarsen.hpp>

namespace curveskel {

/// As `coarsen`. Preconditions, which are not looked at again: a closed manifold, valid options.
[[nodiscard]] Coarsened coarsen_whole(const Surface& surface, const CoarsenOptions& options,
                                      const Monitor& monitor);

}  // namespace curveskel
