// Connectivity surgery: a contracted surface becomes a graph.
#pragma once

#include <optional>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct SurgeryOptions {
  double shape_weight = 1;       ///< Au et al. 2008, w_a
  double sampling_weight = 0.1;  ///< Au et al. 2008, w_b

  [[nodiscard]] bool operator==(const SurgeryOptions&) const = default;
};

/// Merges vertices into groups by half-edge collapses of the contracted surface, in the order of Au
/// et al.'s shape and sampling costs, until no triangle has three groups; never makes a group of
/// genus > 0. One node per group and one per cut curve along which two groups meet, so the cycle
/// rank is the surface's genus. Empty when the collapses end in triangles that no merge may remove;
/// then contract more gently, or see reeb_groups.
[[nodiscard]] std::optional<PartitionGraph> surgery(const Surface& surface,
                                                    const Contraction& contraction,
                                                    const SurgeryOptions& options,
                                                    const Monitor& monitor);

}  // namespace curveskel
