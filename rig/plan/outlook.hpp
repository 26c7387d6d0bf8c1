// A body as one sees it in a frame, and the frame in which most is seen.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/body_plan.hpp>
#include "rig/plan/curve_tree.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {

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

/// The usual one first. Throws Error(usage) where up and front are one direction.
[[nodiscard]] std::vector<Eigen::Matrix3d> frames_of(const PlanOptions& options);

/// In the usual frame what is seen there; in others what is clear, of that the most symmetric, or
/// a tailed biped. Then a body beside the middle of its box, then one that lies, then one in a
/// pose, then a human that lacks a limb. Where nothing is seen the reason is that of the look that
/// explains most.
[[nodiscard]] Outlook best_outlook(const Surface& surface, const CurveSkeleton& skeleton,
                                   const PlanOptions& options);

/// True if front and rear are images of each other, at least as nearly as left and right: an animal
/// has a head at one end alone.
[[nodiscard]] bool is_alike_from_both_ends(const Outlook& outlook);

}  // namespace curveskel
