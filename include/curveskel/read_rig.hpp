// Rigs in: glTF 2.0, text or binary; joints alone from other formats, too.
#pragma once

#include <filesystem>
#include <optional>

#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>

namespace curveskel {

/// The joints of all skins in the scene, with weights by the vertices that `read_polygons` gives;
/// nothing where the file has no skin or is of another format. A joint rests where the scene has
/// its node, as the vertices that `read_polygons` gives do. Its parent is the nearest node above it
/// that is a joint. Joints without a name are called joint_1 and so on. Joints of a VRM, 1.0 or
/// 0.x, have its roles, in VRM 1.0's words. Weights are divided by their sum. Throws
/// Error(Fault::input) where indices, matrices or weights are wrong. Linear in the file.
[[nodiscard]] std::optional<Rig> read_rig(const std::filesystem::path& path,
                                          const Monitor& monitor = {});

/// The joints alone (weights has no rows) of a glTF file with a skin, of an FBX file with
/// limbs or a COLLADA file with joints (where its nodes rest, in its numbers), of the JSON that
/// `format_rig` writes, or of RigNet's text; parents before their children, whatever the order in
/// the file. Throws Error(Fault::input) where there are no joints, where parents lead to no root,
/// or where a name or number is wrong. Linear in the file.
[[nodiscard]] Rig read_joints(const std::filesystem::path& path, const Monitor& monitor = {});

}  // namespace curveskel
