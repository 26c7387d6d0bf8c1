// VRM 1.0: a binary glTF file that says which joint is which bone of a human.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include <curveskel/rig.hpp>
#include <curveskel/rig_files.hpp>

namespace curveskel {

/// Throws Error(Fault::usage) where name, author or licence are missing or the licence is no
/// address of the web, Error(Fault::input) where the rig has not the fifteen bones that VRM
/// requires.
void require_vrm(const Rig& rig, const VrmMeta& meta);

/// Adds the extension VRMC_vrm to a glTF's JSON. `nodes`: of the rig's joints. Roles that are no
/// bones of VRM have no entry; of several joints with one role the first is the bone.
void add_vrm(nlohmann::ordered_json& gltf, const Rig& rig, const std::vector<int>& nodes,
             const VrmMeta& meta);

/// The same in a file whose last skin has the rig's joints, in their order.
void add_vrm(nlohmann::ordered_json& gltf, const Rig& rig, const VrmMeta& meta);

/// Of a file that keeps its joints. One that is a VRM stays the VRM that it is, in VRM 1.0 with the
/// texts of `meta`, where there are any; else as `require_vrm` and `add_vrm`.
void keep_vrm(nlohmann::ordered_json& gltf, const Rig& rig, const std::vector<int>& nodes,
              const VrmMeta& meta);

/// `add_vrm` in a binary file.
[[nodiscard]] std::string with_vrm(const std::string& glb, const Rig& rig, const VrmMeta& meta);

}  // namespace curveskel
