#include "rig/fbx/fbx_looks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_joints.hpp"
#include "rig/fbx/fbx_layers.hpp"
#include "rig/fbx/fbx_look_materials.hpp"
#include "rig/gltf/dressed_rows.hpp"
#include "rig/gltf/vertex_maps.hpp"
#include "surface/read/fbx_axes.hpp"
#include "surface/read/fbx_bind.hpp"
#include "surface/read/fbx_meshes.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

class FbxLookReader {
 public:
  FbxLookReader(const FileBytes& file, const FbxRecord& root, const FbxScene& scene,
                const Monitor& monitor)
      : file_(file),
        root_(root),
        scene_(scene),
        joints_(fbx_joints(scene)),
        meshes_(file, monitor) {}

  DressedFile read(bool as_bound) {
    std::optional<FbxBind> bind;
    if (as_bound) bind.emplace(scene_);
    for_each_fbx_mesh(file_, scene_, bind ? &*bind : nullptr,
                      [this](const FbxShownMesh& mesh) { add(mesh); });
    made_.mesh.to_gltf = fbx_to_gltf(root_);
    rows_.place(meshes_.soup(SurfaceFormat::fbx));
    return std::move(made_);
  }

 private:
  void add(const FbxShownMesh& mesh) {
    const std::vector<Eigen::Matrix3d> moving = vertex_maps(
        mesh.skin, mesh.frame, static_cast<std::size_t>(mesh.polygons.positions.rows()));
    made_.mesh.parts.push_back({fbx_name(mesh.model), static_cast<std::size_t>(first_vertex_),
                                made_.mesh.material_of_face.size()});
    if (mesh.skin.joints.empty()) {
      made_.mesh.parts.back().joint = fbx_joint_above(scene_, joints_, mesh.model);
    }
    add_shapes(mesh, moving);
    first_vertex_ += mesh.polygons.positions.rows();
    meshes_.add(mesh.polygons, mesh.frame, mesh.skin);
    const FbxRecord& geometry = mesh.geometry;
    const auto textures = layers(geometry, "LayerElementUV", "UV", "UVIndex", 2);
    const auto colours = layers(geometry, "LayerElementColor", "Colors", "ColorIndex", 4);
    made_.mesh.parts.back().texture_sets = names_of(fbx_sets(geometry, "LayerElementUV"));
    made_.mesh.parts.back().colour_sets = names_of(fbx_sets(geometry, "LayerElementColor"));
    const FbxLayer normals(file_, geometry.child("LayerElementNormal"), "Normals", "NormalsIndex",
                           3);
    const FbxLayer materials(file_, geometry.child("LayerElementMaterial"), "Materials", "", 1);

    const std::vector<int> numbers = materials_of(mesh);
    const std::vector<Eigen::Matrix3d> maps = normal_maps(moving);
    const bool mirrored = is_mirrored(mesh.frame, mesh.skin);
    rows_.begin_mesh();
    const std::vector<std::int64_t>& offsets = mesh.polygons.offsets;
    for (std::size_t p = 0; p + 1 < offsets.size(); ++p) {
      const auto begin = idx(offsets[p]);
      const auto end = idx(offsets[p + 1]);
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t c = mirrored ? begin + end - 1 - k : k;
        const FbxCorner corner{c, idx(mesh.polygons.corners[c]), p};
        const auto row_in = [&](const FbxLayer& layer) { return layer.row_of(corner); };
        made_.mesh.corners.push_back(
            {-1, rows_.texture_in(textures, row_in),
             rows_.normal_in(normals, row_in, corner.vertex, maps[corner.vertex]),
             rows_.colour_in(colours, row_in)});
      }
      const std::int64_t row = materials.row_of({begin, 0, p});
      const double number = row < 0 ? 0 : materials.value(idx(row), 0);
      const bool is_there = number >= 0 && number < static_cast<double>(numbers.size());
      made_.mesh.material_of_face.push_back(is_there ? numbers[static_cast<std::size_t>(number)]
                                                     : -1);
    }
  }

  static std::vector<std::string> names_of(const std::vector<const FbxRecord*>& sets) {
    std::vector<std::string> names;
    for (const FbxRecord* set : sets) {
      const FbxRecord* name = set->child("Name");
      names.emplace_back(name == nullptr ? std::string_view() : name->text(0));
    }
    return names;
  }

  /// Those with that name.
  [[nodiscard]] std::vector<FbxLayer> layers(const FbxRecord& geometry, std::string_view name,
                                             std::string_view values, std::string_view indices,
                                             std::size_t width) const {
    std::vector<FbxLayer> sets;
    for (const FbxRecord* record : fbx_sets(geometry, name)) {
      sets.emplace_back(file_, record, values, indices, width);
    }
    return sets;
  }

  void add_shapes(const FbxShownMesh& mesh, const std::vector<Eigen::Matrix3d>& moving) {
    const Eigen::Index vertices = mesh.polygons.positions.rows();
    for (const FbxShape& shape : fbx_shapes(file_, scene_, mesh.geometry, vertices)) {
      made_.mesh.shapes.push_back({shape.name, made_.mesh.parts.size() - 1, shape.weight, {}});
      DressedShape& made = made_.mesh.shapes.back();
      for (std::size_t k = 0; k < shape.vertices.size(); ++k) {
        const auto place =
            static_cast<std::int32_t>(first_vertex_) + static_cast<std::int32_t>(shape.vertices[k]);
        const Eigen::Vector3d move = moving[shape.vertices[k]] * shape.moves[k].transpose();
        if (move.allFinite()) made.moves[place] = move;
      }
    }
  }

  /// Of the model's materials, in their order, the numbers in all of the file.
  std::vector<int> materials_of(const FbxShownMesh& mesh) {
    std::vector<int> numbers;
    const FbxRecord* culling = mesh.model.child("Culling");
    const bool two_sided = culling != nullptr && culling->text(0) == "CullingOff";
    for (const FbxRecord* material : scene_.below(mesh.model, "Material")) {
      const auto [entry, is_new] =
          numbers_.try_emplace(material, static_cast<int>(made_.materials.size()));
      if (is_new) {
        made_.materials.push_back(fbx_look_of(file_, root_, scene_, *material, mesh.geometry));
        made_.mesh.materials.push_back(made_.materials.back().name);
      }
      made_.materials[idx(entry->second)].look->two_sided |= two_sided;
      numbers.push_back(entry->second);
    }
    return numbers;
  }

  const FileBytes& file_;
  const FbxRecord& root_;
  const FbxScene& scene_;
  std::vector<FbxJoint> joints_;
  PlacedMeshes meshes_;
  DressedFile made_;
  DressedRows rows_{made_.mesh};
  std::map<const FbxRecord*, int> numbers_;  // of materials
  Eigen::Index first_vertex_ = 0;            // of the mesh
};

}  // namespace

DressedFile read_fbx_looks(const FileBytes& file, bool as_bound, const Monitor& monitor) {
  const FbxRecord root = parse_fbx(file);
  require_fbx_version(file, root);
  const FbxScene scene(file, root);
  return FbxLookReader(file, root, scene, monitor).read(as_bound);
}

}  // namespace curveskel
