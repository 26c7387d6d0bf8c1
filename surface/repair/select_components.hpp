// The components of a closed surface that are worth a skeleton.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// Why a component stays or goes.
enum class Fate : std::uint8_t { kept, copy, crumb, speck, not_chosen };

struct SelectionRules {
  double copy_distance = 0;  ///< model units: nearer vertices of two components are the same
  double least_area = 0;     ///< of the largest component's; less is a speck
  bool by_place = false;     ///< the largest of those whose boxes hold the middle of its own box,
                             ///< else of those that meet it: no floor makes specks of fingers
  double least_crumb = 0;    ///< of the largest that it touches; less is a crumb
  int most = 0;              ///< components, 0 = all
};

/// Keeps the components marked so, in order. Returns the new index of each vertex, -1 = gone.
std::vector<std::int32_t> keep_components(Surface& surface, const Topology& counted,
                                          const std::vector<Fate>& fates);

/// Drops, and counts in `result.repairs`, in this order: components that coincide with an earlier
/// one vertex by vertex, within the copy distance; those that touch, in a position that both have,
/// directly or through others, a much larger one; those with little area; and all but the largest
/// by area (the earlier one of two equals). Vertices of crumbs follow the nearest one that stays.
/// O(#V log #V). Throws Cancelled on a stop.
void leave_out_components(RepairedSurface& result, const SelectionRules& rules,
                          const std::stop_token& stop);

}  // namespace curveskel
