// The numbers of each branch that tables have. docs/numbers.md defines them.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

enum class BranchKind : std::uint8_t { chain, leaf, inner, ring };

inline constexpr NameTable<BranchKind, 4> branch_kinds{{
    {BranchKind::chain, "chain", "from tip to tip"},
    {BranchKind::leaf, "leaf", "from a junction to a tip"},
    {BranchKind::inner, "inner", "from a junction to a junction, or back to the same"},
    {BranchKind::ring, "ring", "closed, without a junction"},
}};

/// Lengths and radii in model units.
struct BranchMeasures {
  BranchKind kind = BranchKind::chain;
  double length = 0;      ///< along the branch
  double chord = 0;       ///< straight from its start to its end; 0 of one that closes
  double tortuosity = 0;  ///< length / chord - 1: 0 = straight; NaN where it closes
  /// Over the length, linear between nodes. NaN without radii, as the next two.
  double mean_radius = 0;
  double least_radius = 0;
  double largest_radius = 0;
};

/// Of each of `branches(skeleton)`. O(#N + #E log #E).
[[nodiscard]] std::vector<BranchMeasures> branch_measures(const CurveSkeleton& skeleton);

}  // namespace curveskel
