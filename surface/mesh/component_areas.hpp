// Areas of components.
#pragma once

#include <vector>

#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// By component. `counted` is of this surface. O(#F).
[[nodiscard]] std::vector<double> component_areas(const Surface& surface, const Topology& counted);

}  // namespace curveskel
