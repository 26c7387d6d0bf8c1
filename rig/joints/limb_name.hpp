// The names of limbs' joints, as `place_joints` and `name_sides` give them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// 'L' or 'R' of a name that ends in ".L" or ".R", else 0.
[[nodiscard]] inline char side_in(std::string_view name) {
  if (name.ends_with(".L")) return 'L';
  return name.ends_with(".R") ? 'R' : '\0';
}

/// "hand" of "hand.L"; others as they are.
[[nodiscard]] inline std::string_view without_side(std::string_view name) {
  return side_in(name) == 0 ? name : name.substr(0, name.size() - 2);
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
  parts.side = name.substr(without_side(name).size());
  name.resize(name.size() - parts.side.size());
  const std::size_t at = name.rfind('_');
  const bool counts = at != std::string::npos && name.find("limb") < at;
  parts.limb = name.substr(0, counts ? at : std::string::npos);
  if (counts) parts.rest = name.substr(at);
  return parts;
}

}  // namespace curveskel
