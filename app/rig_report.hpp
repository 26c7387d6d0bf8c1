// The report of a rig, as JSON.
#pragma once

#include <string>

#include <curveskel/rig_character.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RigRecord {
  const Surface& given;  ///< of the file
  const CharacterRig& character;
  const Rig& written;  ///< of the character, as in the files: in its pose, with or without ends
  const std::string& file;
  double seconds = 0;
};

/// Plan, roles, parts, joints, checks of the weights. Numbers and positions of joints are those of
/// the written rig; the checks are made in the pose of the surface. Ends with a newline.
[[nodiscard]] std::string rig_report_json(const RigRecord& record);

}  // namespace curveskel
