// One skeleton at many levels: which branches stay as the limit of their lives rises.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/lives.hpp>

namespace curveskel {

/// The life of what stays at every level: edges on cycles, and the way between the two eldest tips
/// of a component without any. Above every limit.
inline constexpr double lives_for_ever = 1e9;

/// True if each node has its number.
[[nodiscard]] bool has_lives(const CurveSkeleton& skeleton);

/// Gives each tip the largest life of those whose vertices lie on its branch: by `node_of_vertex`,
/// which is by the vertices that the lives name. O(#N + #E log #E).
void set_lives(CurveSkeleton& skeleton, const std::vector<TipLife>& lives);

/// #E: an edge divides what it is in; it lives as long as the clearest tip on the side that has the
/// less clear one. Hence no edge outlives one that it hangs from, and the edges above any limit are
/// connected wherever all edges are. 0 where the skeleton has no lives, but for cycles.
/// O(#N + #E).
[[nodiscard]] Eigen::VectorXd edge_lives(const CurveSkeleton& skeleton);

/// Of each of `branches(skeleton)`.
struct BranchLevel {
  double life = 0;  ///< of its edges
  int parent = -1;  ///< the branch that it hangs from at its inner end: the one from which that end
                    ///< is reached, outwards from what stays at every level; -1 = of none, it is
                    ///< such a branch. Hence a forest, along which lives never rise
  double merge = -1;  ///< between two junctions: their distance over the sum of their radii. Under
                      ///< 1 they may be drawn as one. -1 for other branches, and without radii
};
/// Throws Error(Fault::input) where edges are not sorted (see Edges).
[[nodiscard]] std::vector<BranchLevel> branch_levels(const CurveSkeleton& skeleton);

/// The edges whose life is at least the limit, and their nodes, which stay where they are; nodes
/// without an edge stay. A vertex whose node goes belongs to the node that its branch hung from.
/// Components and cycle rank stay, and what lives for ever stays at every limit. A skeleton without
/// lives stays whole. O(#V + #N + #E).
[[nodiscard]] CurveSkeleton level_of(const CurveSkeleton& skeleton, double least_life);

/// The limit of a level of detail: .5 or more: 0, everything that was extracted; below, from .3 up
/// to 4 at 0, where limbs alone stay. Precondition: 0..1.
[[nodiscard]] double least_life(double detail);

/// Above a detail of .5, where `extract` adds branches for tips that the curve does not show: as
/// much of its life a tip must lack, from 1.15 at .5 down to .15 at 1, as tips lack that have a
/// branch. 1.15 below. Precondition: 0..1.
[[nodiscard]] double least_deficit(double detail);

/// The limits in the middle of the widest gaps between the lives of the branches (their ratios),
/// ascending, at most `most`, the first of them 0. Fewer where there are fewer different lives.
[[nodiscard]] std::vector<double> level_limits(const CurveSkeleton& skeleton, int most);

}  // namespace curveskel
