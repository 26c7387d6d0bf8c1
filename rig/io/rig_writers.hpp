// One writer for each format of rigs, behind `format_rig`.
#pragma once

#include <string>
#include <vector>

#include <curveskel/rig.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/surface.hpp>
#include "base/decimal.hpp"

namespace curveskel {

/// `format` is glb or gltf.
[[nodiscard]] std::string format_gltf_rig(const Surface& surface, const Rig& rig, RigFormat format,
                                          const std::string& name, const std::string& provenance);
[[nodiscard]] std::string format_json_rig(const Rig& rig, const std::string& provenance);
[[nodiscard]] std::string format_npz_rig(const Rig& rig);
[[nodiscard]] std::string format_rignet_rig(const Rig& rig);
[[nodiscard]] std::string format_bvh_rig(const Rig& rig);

/// The shortest text that reads back as the same number.
template <typename Number>
[[nodiscard]] std::string number_text(Number value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

/// Each joint's name without blanks, for formats that part words by these; empty ones become
/// joint_1 and so on, of several alike the later ones get a number.
[[nodiscard]] std::vector<std::string> names_as_words(const Rig& rig);

}  // namespace curveskel
