#include "rig/gltf/dressed_file.hpp"

#include <algorithm>
#include <utility>

#include "rig/dae/dae_looks.hpp"
#include "rig/fbx/fbx_looks.hpp"
#include "rig/gltf/colours.hpp"
#include "rig/gltf/obj_file.hpp"
#include "rig/gltf/obj_materials.hpp"
#include "rig/gltf/ply_looks.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

DressedFile read_obj_looks(const FileBytes& file, std::vector<std::string>& notes,
                           const Monitor& monitor) {
  ObjFile obj = read_obj_file(file, monitor);
  std::vector<DressedMaterial> materials = read_obj_materials(obj, file, notes, monitor);
  if (!materials.empty()) {
    obj.mesh.drop_colours();  // of what the materials show, mostly, of which they would be factors
  } else if (!obj.mesh.colours.empty()) {
    materials.push_back({coloured_material, MaterialLook{}});
    obj.mesh.materials.emplace_back(coloured_material);
    std::fill(obj.mesh.material_of_face.begin(), obj.mesh.material_of_face.end(), 0);
  }
  return {std::move(obj.mesh), std::move(materials)};
}

std::optional<DressedFile> looks_of(const FileBytes& file, bool as_bound,
                                    std::vector<std::string>& notes, const Monitor& monitor) {
  const auto format = surface_format_of(file);
  if (format == SurfaceFormat::dae) return read_dae_looks(file, as_bound, notes, monitor);
  if (format == SurfaceFormat::fbx) return read_fbx_looks(file, as_bound, monitor);
  if (format == SurfaceFormat::ply) return read_ply_looks(file, monitor);
  if (format == SurfaceFormat::obj) return read_obj_looks(file, notes, monitor);
  return std::nullopt;
}

}  // namespace

std::optional<DressedFile> read_dressed_file(const FileBytes& file, const LookOptions& options,
                                             std::vector<std::string>& notes,
                                             const Monitor& monitor) {
  std::optional<DressedFile> found = looks_of(file, options.as_bound, notes, monitor);
  if (!found || !found->mesh.is_bare() || options.without_look) return found;
  if (options.with_polygons && found->mesh.has_polygons()) return found;
  return std::nullopt;
}

}  // namespace curveskel
