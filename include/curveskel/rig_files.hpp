// Rig files, out: glTF 2.0.
#pragma once

#include <string>
#include <string_view>

#include <curveskel/advanced/names.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class RigFormat { glb, gltf };

inline constexpr NameTable<RigFormat, 2> rig_formats{{
    {RigFormat::glb, "glb", "glTF 2.0, one binary file"},
    {RigFormat::gltf, "gltf", "glTF 2.0, text with its numbers inside"},
}};

/// The surface with its joints and weights, for Blender and whatever else reads glTF; give the
/// bytes to `write_file`. Vertices and triangles keep their order, positions and weights are in
/// single precision (as glTF has them), normals are those of `vertex_normals`, the same for
/// all vertices in one place. Joints are turned as `bone_axes` says (rig/bone_axes.hpp). All hang
/// from one node named `name`. `provenance` goes to the file's generator.
/// Precondition: weights have a row for each vertex, of sum 1 and at most four joints.
/// Throws Error(Fault::output) where there are more than 65,536 joints or where single
/// precision does not suffice for the coordinates. O(#V + #F + joints).
[[nodiscard]] std::string format_rig(const Surface& surface, const Rig& rig, RigFormat format,
                                     const std::string& name, const std::string& provenance);

}  // namespace curveskel
