// What a rigger would object to in weights: vertices that nothing moves, islands, stretch, loss of
// volume, limbs that move one another.
#pragma once

#include <array>
#include <vector>

#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct WeightChecks {
  Eigen::Index vertices = 0;
  Eigen::Index unweighted = 0;                    ///< vertices without a joint
  std::array<Eigen::Index, 4> with_influences{};  ///< vertices with 1, 2, 3, and 4 or more joints
  std::vector<int> idle;                          ///< joints that move nothing

  /// Pieces of a joint's vertices (those with a share above .1, connected by faces, vertices in one
  /// place as one) apart from its heaviest (area times share) in the same component of the surface.
  struct Island {
    int joint = 0;
    Eigen::Index vertices = 0;
    bool follows = false;  ///< all of it
  };
  std::vector<Island> islands;  ///< by joint

  /// With the joint turned by 45 degrees, either way about two axes across its bone, all that hangs
  /// from it along: the worst of the four.
  struct Pose {
    int joint = 0;
    double stretch = 1;  ///< 99th percentile, over the edges that bend, of new over old length, or
                         ///< the inverse if that is more
    double volume = 1;   ///< of the surface, new over old, whichever is farther from 1
  };
  std::vector<Pose> poses;  ///< of each joint but roots and idle ones

  /// Vertices with a share above .05 of joints that are three steps or more in the hierarchy from
  /// the joint that moves them most: fingers that move each other.
  Eigen::Index bleeding = 0;
};

/// `follows` is as in CharacterRig; empty: no vertex does. Precondition: weights have a row for
/// each vertex. O(#V log #V + weights times the depth of the hierarchy), in the memory of #V + #F +
/// weights.
[[nodiscard]] WeightChecks check_weights(const Surface& surface, const Rig& rig,
                                         const std::vector<bool>& follows = {});

}  // namespace curveskel
