// Which branch, junction and vertex of one surface is which in another: the same body in another
// pose, another of its kind, a later step of growth.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
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
  /// The shapes alone are compared where the vertices would tell, see `match_inputs`.
  bool by_shape = false;
};

/// Numbers are those of `branches` of either skeleton.
struct BranchPair {
  int a = -1;
  int b = -1;
  bool reversed = false;   ///< a's start is b's end
  bool ambiguous = false;  ///< the surface does not tell b from another branch as like to a

  [[nodiscard]] bool operator==(const BranchPair&) const = default;
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
/// other, those on cycles by the latter alone. Small components move with what they sit on. The way
/// that leaves the least apart is taken. Where another fits as well and gives another branch, the
/// pair is ambiguous. Sizes are over the square roots of the areas. docs/match.md has the method.
/// Throws Error(Fault::input) for a skeleton without edges or a vertex map, without radii and
/// places that are finite, and of which no vertex has a node; Cancelled on a stop. O(#V log #V),
/// for the tips up to the fourth power, of at most 16 candidates for each.
[[nodiscard]] SkeletonMatch match_skeletons(const MatchSide& a, const MatchSide& b,
                                            const MatchOptions& options = {},
                                            const Monitor& monitor = {});

/// For surfaces whose vertices are known in each other, as in the frames of an animation;
/// vertex_of_a is #V of a, the vertex of b, -1 = not known. Tips are paired as above by where their
/// surroundings are known to go, branches by their division of the tips and by the vertices that
/// they share. Nothing is ambiguous, and `vertex_of_a` is what is given. Errors as of
/// `match_skeletons`; also Error(Fault::input) for another number of vertices, or a vertex that b
/// does not have. O(#V), for the tips as above.
[[nodiscard]] SkeletonMatch match_by_vertices(const MatchSide& a, const MatchSide& b,
                                              const Eigen::VectorXi& vertex_of_a,
                                              const Monitor& monitor = {});

/// Polygons as given, and what was made of them; alive as long as they are used.
struct MatchInput {
  const PolygonSoup& soup;
  const RepairedSurface& repaired;
  const CurveSkeleton& skeleton;  ///< `node_of_vertex` is by the repaired surface's vertices
};

struct InputMatch {
  SkeletonMatch match;
  Eigen::VectorXi vertex_of_a;  ///< #V of a's soup: the vertex of b's soup, -1 = none
  bool by_vertices = false;     ///< both soups have the same polygons, see `match_inputs`
};

/// `match_by_vertices` if both soups have the same polygons of the same vertices, which two shapes
/// have only if one is the other in another pose or form; else, and with `by_shape`,
/// `match_skeletons`. If no polygons share a vertex, as in STL files, all soups of as many polygons
/// are alike in that: then the same corners must also coincide in both. Errors as of these.
[[nodiscard]] InputMatch match_inputs(const MatchInput& a, const MatchInput& b,
                                      const MatchOptions& options = {},
                                      const Monitor& monitor = {});

}  // namespace curveskel
