// Any bytes as a file with a look: an error about the input, none, or a mesh that holds together.
// CURVESKEL_FORMAT is dae, fbx, obj or ply.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include "rig/dae/dae_looks.hpp"
#include "rig/fbx/fbx_looks.hpp"
#include "rig/fbx/fbx_shape_animations.hpp"
#include "rig/gltf/obj_file.hpp"
#include "rig/gltf/ply_looks.hpp"

namespace {

using namespace curveskel;

void require(bool holds) {
  if (!holds) std::abort();
}

[[maybe_unused]] std::optional<DressedMesh> mesh_of(std::optional<DressedFile> read) {
  if (!read) return std::nullopt;
  require(read->materials.size() == read->mesh.materials.size());
  return std::move(read->mesh);
}

[[maybe_unused]] std::optional<DressedMesh> read_dae_look(const FileBytes& file) {
  std::vector<std::string> notes;
  return mesh_of(read_dae_looks(file, true, notes, {}));
}

/// Its shapes over time are those of the mesh.
[[maybe_unused]] std::optional<DressedMesh> read_fbx_look(const FileBytes& file) {
  const std::optional<DressedMesh> mesh = mesh_of(read_fbx_looks(file, true, {}));
  for (const ShapeAnimation& animation : read_fbx_shape_animations(file, {})) {
    for (const ShapeTrack& track : animation.tracks) {
      require(track.part < mesh->parts.size() && track.weights.size() == track.seconds.size());
      const auto is_of_part = [&](const DressedShape& shape) { return shape.part == track.part; };
      const auto shapes = std::ranges::count_if(mesh->shapes, is_of_part);
      for (const std::vector<double>& row : track.weights) {
        require(row.size() == static_cast<std::size_t>(shapes));
      }
    }
  }
  return mesh;
}

[[maybe_unused]] std::optional<DressedMesh> read_obj_look(const FileBytes& file) {
  return read_obj_file(file, {}).mesh;
}

[[maybe_unused]] std::optional<DressedMesh> read_ply_look(const FileBytes& file) {
  return mesh_of(read_ply_looks(file, {}));
}

void check(const DressedMesh& mesh) {
  const std::size_t places = mesh.places.size() / 3;
  require(mesh.places.size() % 3 == 0);
  for (const DressedPart& part : mesh.parts) {
    require(part.texture_sets.size() <= most_sets && part.colour_sets.size() <= most_sets);
  }
  for (const DressedShape& shape : mesh.shapes) require(shape.part < mesh.parts.size());
  require(mesh.offsets.front() == 0);
  require(mesh.offsets.back() == static_cast<std::int64_t>(mesh.corners.size()));
  require(mesh.material_of_face.size() + 1 == mesh.offsets.size());
  for (std::size_t f = 1; f < mesh.offsets.size(); ++f) {
    require(mesh.offsets[f - 1] <= mesh.offsets[f]);
  }
  const auto is_below = [](std::int64_t index, std::size_t end) {
    return index < static_cast<std::int64_t>(end);
  };
  for (const DressedCorner& corner : mesh.corners) {
    require(corner.place >= 0 && is_below(corner.place, places));
    require(corner.texture >= -1 && is_below(corner.texture, mesh.textures.size()));
    require(corner.normal >= -1 && is_below(corner.normal, mesh.normals.size()));
    require(corner.colour >= -1 && is_below(corner.colour, mesh.colours.size()));
  }
  for (const int material : mesh.material_of_face) {
    require(material >= -1 && is_below(material, mesh.materials.size()));
  }
  for (const DressedShape& shape : mesh.shapes) {
    for (const auto& [place, move] : shape.moves) {
      require(place >= 0 && is_below(place, places) && move.allFinite());
    }
  }
}

}  // namespace

#define CURVESKEL_LOOK_OF(format) CURVESKEL_LOOK_OF_(format)
#define CURVESKEL_LOOK_OF_(format) read_##format##_look

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileBytes file{"/nonexistent/fuzzed",
                       std::string(reinterpret_cast<const char*>(data), size)};
  try {
    const auto mesh = CURVESKEL_LOOK_OF(CURVESKEL_FORMAT)(file);
    if (mesh) check(*mesh);
  } catch (const Error& error) {
    require(error.fault() == Fault::input);
  }
  return 0;
}
