// COLLADA: every mesh that the scene shows, where the scene shows it. A skinned mesh is taken in
// its rest pose, in which its joints are as their nodes place them, or as it was bound. Units and
// axes are the file's.
#include <string>
#include <string_view>

#include "surface/read/dae_document.hpp"
#include "surface/read/dae_scene.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {
namespace {

constexpr std::string_view dae_start = "<COLLADA";

}  // namespace

PolygonSoup read_dae(const FileBytes& file, const Monitor& monitor, const ReadOptions& options) {
  const XmlElement root = parse_dae(file);
  monitor.report("read", 0.2);
  const DaeDocument document(file, root);
  PlacedMeshes meshes(file, monitor);
  const bool posed = for_each_dae_mesh(
      document, monitor, options.as_bound,
      [&](const DaeShownMesh& shown) { meshes.add(shown.mesh.polygons, shown.frame, shown.skin); });
  PolygonSoup soup = meshes.soup(SurfaceFormat::dae);
  soup.posed = posed;
  soup.z_is_up = has_z_up(document);
  soup.to_gltf = dae_to_gltf(document).linear();
  return soup;
}

bool looks_like_dae(const FileBytes& file) { return begins_as_xml(file, dae_start); }

}  // namespace curveskel
