// The frame in which most is seen of a body.
#pragma once

#include <curveskel/body_plan.hpp>
#include "rig/plan/looks.hpp"

namespace curveskel {

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
