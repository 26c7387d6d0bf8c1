// The report of a rig, as JSON.
#pragma once

#include <string>

#include <curveskel/rig_character.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RigRecord {
  const Surface& given;  ///< of the file
  const CharacterRig& character;
  const std::string& file;
  double seconds = 0;
};

/// Plan, roles, parts, joints, checks of the weights. Ends with a newline.
[[nodiscard]] std::string rig_report_json(const RigRecord& record);

}  // namespace curveskel
