// The readers behind `read_rig`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include "surface/read/file_bytes.hpp"
#include "surface/read/gltf_scene.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// The work of `read_rig` once the file is in memory.
[[nodiscard]] std::optional<Rig> read_gltf_rig(const FileBytes& file, const Monitor& monitor);

struct GltfRig {
  Rig rig;
  std::vector<int> nodes;  ///< of each joint
};

/// The joints of all skins that move something in the scene, and their weights there; none where no
/// skin does. Throws Error(Fault::input) as `read_rig`.
[[nodiscard]] GltfRig rig_of_scene(const FileBytes& file, const tinygltf::Model& model,
                                   const GltfScene& scene);

/// Joints without a name are called joint_1 and so on, by their place in `names`; where one has
/// that name, with a number behind it.
void name_nameless(std::vector<std::string>& names);

}  // namespace curveskel
