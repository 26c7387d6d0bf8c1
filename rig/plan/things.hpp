// Things whose curves have limbs where bodies have theirs.
#pragma once

#include <string>

#include <curveskel/body_plan.hpp>
#include "rig/plan/looks.hpp"

namespace curveskel {

/// True if all of a bird but its flat wings is made of tubes, or the component that a human's legs
/// hang from: capes and shields are others.
[[nodiscard]] bool has_body_of_tubes(const Outlook& outlook);

/// Why what is seen is no body's plan after all; empty if it may be one. A chair, a table, a car, a
/// box. O(#F log #F) where there is a plan.
[[nodiscard]] std::string why_a_thing(const Outlook& outlook, const Surface& surface,
                                      const PlanOptions& options);

}  // namespace curveskel
