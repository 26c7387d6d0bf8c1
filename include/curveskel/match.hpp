// Which branch, junction and vertex of one surface is which in another: the same body in another
// pose, another of its kind, a later step of growth.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A surface and its skeleton, both alive as long as they are used. Precondition: closed, oriented;
/// the skeleton has radii, and node_of_vertex by the surface's vertices.
struct MatchSide {
  const Surface& surface;
  const CurveSkeleton& skeleton;
};

struct MatchOptions {
  int threads = 0;  ///< at most; 0 = one per core. The result does not depend on it.
};

/// Numbers are those of `branches` of either skeleton.
struct BranchPair {
  int a = -1;
  int b = -1;
  bool reversed = false;   ///< a's start is b's end
  bool ambiguous = false;  ///< the surface does not tell b from another branch as like to a
};

struct SkeletonMatch {
  std::vector<BranchPair> branches;            ///< by a; each branch at most once
  std::vector<std::pair<int, int>> junctions;  ///< nodes of a and of b, by a; each at most once
  Eigen::VectorXi vertex_of_a;  ///< #V of a: the vertex of b; -1 where its branch has no partner
};

/// a's surface is laid onto b's in several ways, each followed from the middle of the body
/// outwards, so that limbs may bend. Tips are paired by the radii on their way to the middle, by
/// the distances along the curve to the other tips, and by where they come to lie; branches by the
/// division of the tips that they make and by how much of their surfaces comes to lie on each
/// other, those on cycles by the latter alone. The way that leaves the least apart is taken. Where
/// another fits as well and gives another branch, the pair is ambiguous. Sizes are over the square
/// roots of the areas. docs/match.md has the method. Throws Error(Fault::input) for a skeleton
/// without edges, radii or a vertex map, Cancelled on a stop. O(#V log #V), for the tips up to the
/// fourth power, of at most 16 candidates for each.
[[nodiscard]] SkeletonMatch match_skeletons(const MatchSide& a, const MatchSide& b,
                                            const MatchOptions& options = {},
                                            const Monitor& monitor = {});

/// #V of a's file: the vertex of b's file, -1 = none; from files to the surfaces that were matched
/// and back by `vertex_of_input`. O(#V).
[[nodiscard]] Eigen::VectorXi matched_input_vertices(const SkeletonMatch& match,
                                                     const RepairedSurface& a,
                                                     const RepairedSurface& b);

}  // namespace curveskel
