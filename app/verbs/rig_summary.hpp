// The lines in which `curveskel rig` tells of its result.
#pragma once

#include <string>

#include <curveskel/body_plan.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_parts.hpp>

namespace curveskel {

/// "49 joints, 12 of them tips that move nothing".
[[nodiscard]] std::string joints_in_words(const Rig& rig);

/// Empty where nothing follows.
[[nodiscard]] std::string parts_in_words(const RigParts& parts);

/// Empty where no plan was looked for.
[[nodiscard]] std::string plan_in_words(const BodyPlan& plan);

}  // namespace curveskel
