// The curve of a body as a tree in the body's own frame: x to its left, y up, z to its front.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>
#include "rig/joints/rooted_tree.hpp"

namespace curveskel {

struct CurveTree {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<double> radii;
  std::vector<std::vector<int>> neighbours;
  std::vector<Eigen::Vector3d> vertices;  ///< of the surface
  std::vector<int> node_of_vertex;        ///< -1 = none
  std::vector<Eigen::Vector3d> spread;    ///< points evenly over the surface
  std::vector<int> component;             ///< by own node: of the skeleton
  double size = 0;                        ///< longest side of the surface's box
  double ground = 0;                      ///< lowest y
  double height = 0;
  double middle = 0;      ///< x of the mirror plane
  int cycles = 0;         ///< of the skeleton, which are cut here
  int own_nodes = 0;      ///< the first ones; others stand for a limb that the body lacks
  std::vector<int> cuts;  ///< nodes at which cycles are cut, ascending: tips here, but no limb's

  [[nodiscard]] bool is_tip(int node) const;
  [[nodiscard]] double aside(int node) const;  ///< x from the mirror plane
};

[[nodiscard]] std::vector<int> tips_of(const CurveTree& tree);

/// Of the first so many nodes the one whose ball is nearest to the point, of several the lowest.
[[nodiscard]] int nearest_ball(const CurveTree& tree, int nodes, const Eigen::Vector3d& point);

/// A body that is looked at from several sides; both its surface and its curve must outlive this.
class LookedAt {
 public:
  LookedAt(const Surface& surface, const CurveSkeleton& skeleton)
      : surface_(surface), skeleton_(skeleton), trees_(skeleton, -1, {}) {}

  /// In the frame of these axes. Components hang together as in the rig; cycles are cut.
  [[nodiscard]] CurveTree tree(const Eigen::Matrix3d& axes);

 private:
  [[nodiscard]] const RootedTree& rooted(const Eigen::Vector3d& up);

  const Surface& surface_;
  const CurveSkeleton& skeleton_;
  RootedTrees trees_;
  std::vector<Eigen::Vector3d> spread_;                        // over the surface, as it lies
  std::vector<std::pair<Eigen::Vector3d, RootedTree>> known_;  // by up
};

/// From one node to all.
struct Ways {
  std::vector<int> before;  ///< -1 for the beginning
  std::vector<double> distance;

  /// From the beginning on; only `to` where there is no way.
  [[nodiscard]] std::vector<int> path(int to) const;
  /// From any node to any other: the ways from the beginning to both, but for what these share.
  [[nodiscard]] std::vector<int> between(int from, int to) const;
};
[[nodiscard]] Ways ways_from(const CurveTree& tree, int node);

/// A node and all that hang together with it and are not seen yet, which they are then.
[[nodiscard]] std::vector<int> part_of(const CurveTree& tree, int node, std::vector<char>& seen);

/// From the root of a limb to one of its tips, of the left one and of its mirror image.
struct LimbWay {
  std::vector<int> path;
  std::vector<int> mirror;
  double length = 0;
};

/// A pair of limbs, by its left one.
struct LimbPair {
  int root = -1;              ///< node of the trunk
  std::vector<LimbWay> ways;  ///< one for each tip that has an image, the longest first
  double length = 0;          ///< of the longest
  double lowest = 0;          ///< y of its surface
  std::vector<int> vertices;  ///< of the left one
};

struct Limbs {
  std::vector<char> is_trunk;   ///< by node
  std::vector<int> trunk;       ///< nodes
  std::vector<LimbPair> pairs;  ///< the longest first
};

/// Tips of a curve that belong together.
struct TipPairs {
  std::map<int, int> mate;  ///< left tip -> right one
  std::vector<int> ends;    ///< nodes that the trunk joins, among them one between each pair
};

/// The places in which mirror images of tips are sought.
enum class Images { tips, within_limbs };

/// Of a body that stands alike on both sides: tips that are mirror images of each other.
[[nodiscard]] TipPairs pairs_by_place(const CurveTree& tree, Images images = Images::tips);

/// Halves of which one has three parts of a length where the other has five are no images.
constexpr double most_unlike = 0.25;

/// Of a body in any pose: tips from which the curve is alike on its way to the other one.
[[nodiscard]] TipPairs pairs_by_shape(const CurveTree& tree);

[[nodiscard]] Limbs find_limbs(const CurveTree& tree, const TipPairs& pairs);

/// By node 1 if it is on the way, one side's, and not of the trunk, or hangs from one that is.
[[nodiscard]] std::vector<char> nodes_of_side(const CurveTree& tree, const Limbs& limbs,
                                              const std::vector<int>& way);

/// A limb's course as the mean of both sides, on the left, in equal shares of its length.
struct Course {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> radii;
};
/// Of one side, a right one mirrored.
[[nodiscard]] Course side_course(const CurveTree& tree, const LimbWay& limb, bool is_left);
/// Of both.
[[nodiscard]] Course mean_course(const CurveTree& tree, const LimbWay& limb);

/// How much of the mean course lies within both limbs, which then have their joints on it.
[[nodiscard]] double share_within_both(const CurveTree& tree, const LimbWay& limb);

/// The last point of `course` that is one of the other's, too; 0 where none is.
[[nodiscard]] std::size_t last_shared(const Course& course, const Course& other);

}  // namespace curveskel
