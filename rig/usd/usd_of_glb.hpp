// A rigged glTF file as USD. Internal to rig/.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/gltf/mesh_polygons.hpp"

namespace curveskel {

struct UsdOptions {
  std::string name;  ///< of the whole, for readers
  std::string provenance;
  std::string picture_folder = "textures";  ///< beside the layer, or in the archive
  bool packed = false;                      ///< see `usdz_of`
};

struct UsdLayer {
  std::string text;
  std::vector<SideFile> pictures;  ///< that it names
};

/// A SkelRoot `/Model` with skeletons, nodes as Xforms, meshes (a mesh's primitives as one, a
/// subset for each of several materials), shape keys, materials with their pictures, animations;
/// metres, y up. Meshes that joints move lie in the scene's coordinates, as they were bound.
/// `polygons` of each mesh, if given, take the place of its triangles, as of `fbx_of_glb`. The
/// first animation that moves something is bound; nodes that are no joints have it alone. Left out:
/// cameras, lights, points and lines, moved texture coordinates. `notes` gets a line for each
/// picture that USD cannot show. Precondition: the bytes are a binary glTF file as `format_rig` and
/// `format_rig_into` write it. O(bytes).
[[nodiscard]] UsdLayer usd_of_glb(std::string glb, const UsdOptions& options,
                                  std::vector<std::string>& notes,
                                  const std::vector<MeshPolygons>& polygons = {},
                                  const Monitor& monitor = {});

/// Layer and pictures in one archive as Pixar's usdz has it: nothing compressed, every file's bytes
/// from a multiple of 64 on, the layer, called `name`, first. The same bytes at any time. Throws
/// Error(Fault::output) beyond 4 GB. O(bytes).
[[nodiscard]] std::string usdz_of(const UsdLayer& layer, const std::string& name);

}  // namespace curveskel
