// Connectivity surgery: a contracted surface becomes a graph.
#pragma once

#include <optional>

#include <curveskel/advanced/names.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class SurgeryMethod { own, cgal };

inline constexpr NameTable<SurgeryMethod, 2> surgery_methods{{
    {SurgeryMethod::own, "own", "in the order of Au et al.'s costs; every handle is kept"},
    {SurgeryMethod::cgal, "cgal", "CGAL's: the shortest edge first; handles may be lost"},
}};

struct SurgeryOptions {
  SurgeryMethod method = SurgeryMethod::own;
  double shape_weight = 1;       ///< own: Au et al. 2008, w_a
  double sampling_weight = 0.1;  ///< own: Au et al. 2008, w_b

  [[nodiscard]] bool operator==(const SurgeryOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const SurgeryOptions& options);

/// Merges vertices into groups by half-edge collapses of the contracted surface, in the order of Au
/// et al.'s shape and sampling costs, until no triangle has three groups; never makes a group of
/// genus > 0. One node per group and one per cut curve along which two groups meet, so the cycle
/// rank is the surface's genus. Empty when the collapses end in triangles that no merge may remove;
/// then contract more gently, or see level_set_graph. With SurgeryMethod::cgal the groups are those
/// of cgal_surgery; empty when one of them has a handle of its own.
[[nodiscard]] std::optional<PartitionGraph> surgery(const Surface& surface,
                                                    const Contraction& contraction,
                                                    const SurgeryOptions& options = {},
                                                    const Monitor& monitor = {});

}  // namespace curveskel
