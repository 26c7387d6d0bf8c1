// For components that are closed, but cross themselves so that nothing can go round their handles
// or through their limbs.
#pragma once

#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include "surface/repair/wrap_solid.hpp"

namespace curveskel {

/// A component, by its number in `topology`, and the wrap that stands for it.
struct ComponentWrap {
  int component = 0;
  WrappedSolid wrap;  ///< lengths over the component's own extent
};

/// The surface with the wraps in the place of their components. A wrapped vertex has the nearest
/// one of its wrap; the rims of its holes are rims no more. Counted and said in
/// `repairs`. Precondition: each component at most once.
[[nodiscard]] RepairedSurface with_wraps(const RepairedSurface& repaired,
                                         const std::vector<ComponentWrap>& wraps,
                                         const Monitor& monitor);

}  // namespace curveskel
