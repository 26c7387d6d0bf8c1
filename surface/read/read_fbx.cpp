// FBX from version 7 on, binary and as text: every mesh where its models show it, morphed by the
// weights that the file gives. A skinned mesh is taken in its rest pose, in which its joints are as
// their models place them, or as it was bound. Units and axes are the file's.
#include <algorithm>
#include <string_view>

#include "surface/read/fbx_axes.hpp"
#include "surface/read/fbx_bind.hpp"
#include "surface/read/fbx_meshes.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {

PolygonSoup read_fbx(const FileBytes& file, const Monitor& monitor, const ReadOptions& options) {
  const FbxRecord root = parse_fbx(file);
  monitor.report("read", 0.4);
  require_fbx_version(file, root);
  PlacedMeshes meshes(file, monitor);
  const FbxScene scene(file, root);
  const FbxBind bind(scene);
  for_each_fbx_mesh(file, scene, options.as_bound ? &bind : nullptr, [&](const FbxShownMesh& mesh) {
    meshes.add(mesh.polygons, mesh.frame, mesh.skin);
  });
  PolygonSoup soup = meshes.soup(SurfaceFormat::fbx);
  soup.posed = bind.is_posed();
  soup.z_is_up = fbx_has_z_up(root);
  soup.to_gltf = fbx_to_gltf(root).linear();
  return soup;
}

bool looks_like_fbx(const FileBytes& file) {
  if (is_binary_fbx(file)) return true;
  std::string_view text = std::string_view(file.content).substr(0, 4000);
  for (;;) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (begin == std::string_view::npos) return false;
    text.remove_prefix(begin);
    if (text[0] != ';') return text.starts_with("FBXHeaderExtension:");
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

}  // namespace curveskel
