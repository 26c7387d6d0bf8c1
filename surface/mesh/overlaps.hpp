// Which components of a surface meet, and which lies inside which.
#pragma once

#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

struct Overlaps {
  /// Per component those of which a triangle meets one of its own (crosses or touches it),
  /// ascending.
  std::vector<std::vector<int>> met;
  /// Per component the smallest one that it lies wholly inside of, touching it nowhere; -1 = none.
  std::vector<int> around;
};

/// Meeting is exact. Boxes are compared first: components whose boxes lie apart cost nothing.
/// O(#F + n log n + pairs of boxes that overlap), n the triangles where boxes of components
/// overlap; for each component round another also that of a SurfaceTree. Throws Cancelled on a
/// stop. Precondition: closed oriented 2-manifold, counted by `topology`.
[[nodiscard]] Overlaps overlaps_of(const Surface& surface, const Topology& counted,
                                   const Monitor& monitor);

}  // namespace curveskel
