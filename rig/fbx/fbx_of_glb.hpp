// A rigged glTF file as FBX. Internal to rig/.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/mesh_polygons.hpp"

namespace curveskel {

/// Nodes, meshes (a mesh's primitives as one, with a material for each face), normals, texture
/// coordinates, colours, shape keys, skins, materials with their pictures inside. Meshes that
/// joints move lie in the scene's coordinates, in the pose in which they were bound; metres, y up,
/// +z ahead. `polygons` of each mesh, if given, take the place of its triangles, and vertices are
/// those from before seams parted them; animations of nodes and shape keys (see
/// `add_fbx_animations`). Left out: cameras, lights, points and lines, moved texture coordinates.
/// Precondition: the bytes are a binary glTF file as `format_rig` and
/// `format_rig_into` write it. Throws Error(Fault::output) beyond 4 GB. O(bytes).
[[nodiscard]] std::string fbx_of_glb(std::string glb, const std::string& provenance,
                                     const std::vector<MeshPolygons>& polygons = {},
                                     const Monitor& monitor = {});

}  // namespace curveskel
