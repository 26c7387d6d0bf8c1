// The numbers of each branch and of each junction that tables have. docs/numbers.md defines them.
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

/// Lengths and radii in model units, angles in degrees.
struct BranchMeasures {
  BranchKind kind = BranchKind::chain;
  double length = 0;      ///< along the branch
  double chord = 0;       ///< straight from its start to its end; 0 of one that closes
  double tortuosity = 0;  ///< length / chord - 1, >= 0; 0 = straight; NaN where it closes
  /// Over the length, linear between nodes. NaN without radii, as the next two.
  double mean_radius = 0;
  double least_radius = 0;
  double largest_radius = 0;
  /// Mean over the length, per unit, of cubics near the nodes within two radii.
  double curvature = 0;
  /// The same, weighted by the square of the curvature; positive on a right-handed helix. NaN where
  /// there is no curvature.
  double torsion = 0;
  /// Between the directions in which this branch and its parent (`branch_levels`) leave their
  /// junction: 180 = one goes on where the other ends. NaN without a parent.
  double parent_angle = 0;
  int centrifugal_order = 0;  ///< 1 = at the root, plus one at each junction on the way from there
  /// Strahler: 1 of a leaf; elsewhere the largest of the branches beyond, and one more where two
  /// have it. 0 on a component with cycles.
  int strahler_order = 0;
};

/// Of each of `branches(skeleton)`. Orders count from `root`, and in the components where it is not
/// from the node with the largest radius, the lowest of several. A root within a branch makes that
/// branch the first. Precondition: root < #N, -1 = none chosen. O(#N + #E log #E).
[[nodiscard]] std::vector<BranchMeasures> branch_measures(const CurveSkeleton& skeleton,
                                                          int root = -1);

/// A node of degree 3 or more.
struct JunctionMeasures {
  int node = -1;
  std::vector<int> branches;  ///< that end here, ascending; one that returns is there twice
  /// Degrees between the directions in which these leave the node, from where they leave its
  /// inscribed ball to a radius further, of each pair: 0 and 1, 0 and 2, .., 1 and 2, ..
  std::vector<double> angles;
  /// 1 = the directions lie in one plane, 0 = they fill space alike: 1 less 3 times the least
  /// eigenvalue of the mean of d d' over the unit directions d.
  double planarity = 0;
};

/// Of all junctions, ascending. O(#N + #E log #E).
[[nodiscard]] std::vector<JunctionMeasures> junction_measures(const CurveSkeleton& skeleton);

}  // namespace curveskel
