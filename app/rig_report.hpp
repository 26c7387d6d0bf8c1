// The report of a rig, as JSON.
#pragma once

#include <string>

#include <curveskel/body_plan.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RigRecord {
  const Surface& given;  ///< of the file
  const Rig& rig;        ///< of the file's vertices
  const RigParts& parts;
  const BodyPlan& plan;
  const std::string& file;
  double seconds = 0;
};

/// Plan, roles, parts, joints, checks of the weights. Ends with a newline.
[[nodiscard]] std::string rig_report_json(const RigRecord& record);

}  // namespace curveskel
