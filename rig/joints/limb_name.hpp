// The names of limbs' joints, as `place_joints` and `name_sides` give them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

[[nodiscard]] inline bool ends_with_side(std::string_view name) {
  return name.ends_with(".L") || name.ends_with(".R");
}

/// The names that tell the sides, whatever program the others are for.
[[nodiscard]] inline const std::vector<std::string>& readable_names(const Rig& rig) {
  return rig.readable.empty() ? rig.names : rig.readable;
}

/// "part3_limb4_2.L" taken apart.
struct LimbName {
  std::string limb;  ///< part3_limb4; the whole name where it is no limb's
  std::string rest;  ///< _2, _end
  std::string side;  ///< .L
};

[[nodiscard]] inline LimbName taken_apart(std::string name) {
  LimbName parts;
  if (ends_with_side(name)) {
    parts.side = name.substr(name.size() - 2);
    name.resize(name.size() - 2);
  }
  const std::size_t at = name.rfind('_');
  const bool counts = at != std::string::npos && name.find("limb") < at;
  parts.limb = name.substr(0, counts ? at : std::string::npos);
  if (counts) parts.rest = name.substr(at);
  return parts;
}

}  // namespace curveskel
