// A body as one sees it in a frame.
#pragma once

#include <Eigen/Core>

#include <curveskel/body_plan.hpp>
#include "rig/plan/curve_tree.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {

/// Of a body, with all of its hair.
constexpr std::size_t most_tips = 1000;
/// Of its curves: a hair that is a part of its own has two. More are a tree's or a crowd's.
constexpr int most_ends = 2 * most_tips;

/// The places of the joints of limbs. Of bodies whose sides are not quite images of each other they
/// lie on their own side's curve, and so where a limb is missing; of bodies in a pose where the
/// unposed limb has them.
enum class Sides { images, own, completed, posed };

struct Outlook {
  Eigen::Matrix3d axes;
  CurveTree tree;  ///< of `Sides::posed` the unposed one
  Limbs limbs;
  PlanFound found;
  Sides sides = Sides::images;
  CurveTree posed;  ///< of `Sides::posed` the tree as it is
};

/// By the middle of the box (`images`); by the middle of the tips, for a body whose weapon, hand or
/// missing forearm moves the box (`own`); the same with an image of the longest limb that has none,
/// for a human without an arm or a leg (`completed`); by the shape of its limbs (`posed`).
[[nodiscard]] Outlook look(Sides sides, LookedAt& body, const Eigen::Matrix3d& axes,
                           BodyKind wanted);

/// Two pairs of limbs that are where they should be are no accident.
[[nodiscard]] bool is_clear(BodyKind plan);

/// True for a bird that spreads flat wings between a head and a flat tail.
[[nodiscard]] bool is_sure_bird(const Outlook& outlook);

/// The middle of a human's shin lies in the lowest fifth: a leg whose tip does not has no foot
/// there, whatever of the surface about it is on the ground.
[[nodiscard]] bool has_foot(const CurveTree& tree, const LimbPair& leg);

/// True if the arms leave the trunk above the legs by a head: what forks twice in one place has no
/// trunk. False without arms or legs.
[[nodiscard]] bool has_trunk(const Outlook& outlook);

/// The length of the curve that is trunk or in a pair of limbs.
struct Explained {
  double length = 0;
  double share = 0;
};
[[nodiscard]] Explained explained_by(const Outlook& outlook);

constexpr double most_of_it = 0.8;  // of the curve

/// For humans. Nothing with cycles, which are cut somewhere, and nothing without a head and with
/// stubs for arms: of three limbs and a trunk many things are made.
[[nodiscard]] bool is_whole_but_for_a_limb(const Outlook& outlook);

}  // namespace curveskel
