#include "rig/fbx/fbx_looks.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_layers.hpp"
#include "rig/fbx/fbx_look_materials.hpp"
#include "surface/read/fbx_axes.hpp"
#include "surface/read/fbx_meshes.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

/// By vertex, what moves its surroundings to the world.
std::vector<Eigen::Matrix3d> vertex_maps(const FbxMesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.polygons.positions.rows());
  std::vector<Eigen::Matrix3d> maps(count, Eigen::Matrix3d::Zero());
  std::vector<double> sums(count, 0);
  for (const SkinWeight& one : mesh.skin.weights) {
    maps[one.vertex] += one.weight * mesh.skin.joints[one.joint].linear();
    sums[one.vertex] += one.weight;
  }
  for (std::size_t v = 0; v < count; ++v) {
    maps[v] = sums[v] > 0 ? Eigen::Matrix3d(maps[v] / sums[v]) : mesh.frame.linear();
  }
  return maps;
}

/// The same of normals: the inverse transpose times a number above 0.
std::vector<Eigen::Matrix3d> normal_maps(std::vector<Eigen::Matrix3d> maps) {
  for (Eigen::Matrix3d& map : maps) {
    // The cofactors, which are there for flattened vertices, too.
    const Eigen::Matrix3d moved = map;
    map.col(0) = moved.col(1).cross(moved.col(2));
    map.col(1) = moved.col(2).cross(moved.col(0));
    map.col(2) = moved.col(0).cross(moved.col(1));
    if (moved.determinant() < 0) map = -map;
  }
  return maps;
}

class FbxLookReader {
 public:
  FbxLookReader(const FileBytes& file, const FbxRecord& root, const FbxScene& scene,
                std::vector<std::string>& notes, const Monitor& monitor)
      : file_(file), root_(root), scene_(scene), notes_(notes), meshes_(file, monitor) {}

  std::optional<DressedFile> read() {
    for_each_fbx_mesh(file_, scene_, [this](const FbxMesh& mesh) { add(mesh); });
    if (!made_.mesh.has_looks()) return std::nullopt;
    made_.mesh.to_gltf = fbx_to_gltf(root_);
    const PolygonSoup soup = meshes_.soup(SurfaceFormat::fbx);
    made_.mesh.places.assign(soup.positions.data(), soup.positions.data() + soup.positions.size());
    made_.mesh.offsets = soup.offsets;
    for (std::size_t c = 0; c < soup.corners.size(); ++c) {
      made_.mesh.corners[c].place = soup.corners[c];
    }
    if (has_colours_) notes_.emplace_back("vertex colours are left out");
    if (has_further_sets_) {
      notes_.emplace_back("of several sets of texture coordinates the first is taken");
    }
    return std::move(made_);
  }

 private:
  void add(const FbxMesh& mesh) {
    const std::vector<Eigen::Matrix3d> moving = vertex_maps(mesh);
    add_shapes(mesh, moving);
    first_vertex_ += mesh.polygons.positions.rows();
    meshes_.add(mesh.polygons, mesh.frame, mesh.skin);
    const FbxRecord& geometry = mesh.geometry;
    const FbxLayer textures(file_, geometry, "LayerElementUV", "UV", "UVIndex", 2);
    const FbxLayer normals(file_, geometry, "LayerElementNormal", "Normals", "NormalsIndex", 3);
    const FbxLayer materials(file_, geometry, "LayerElementMaterial", "Materials", "", 1);
    has_colours_ = has_colours_ || geometry.child("LayerElementColor") != nullptr;
    std::size_t sets = 0;
    for (const FbxRecord& child : geometry.children) sets += child.name == "LayerElementUV" ? 1 : 0;
    has_further_sets_ = has_further_sets_ || sets > 1;

    const std::vector<int> numbers = materials_of(mesh.model);
    const std::vector<Eigen::Matrix3d> maps = normal_maps(moving);
    const bool mirrored = is_mirrored(mesh.frame, mesh.skin);
    normal_rows_.clear();
    texture_rows_.clear();
    const std::vector<std::int64_t>& offsets = mesh.polygons.offsets;
    for (std::size_t p = 0; p + 1 < offsets.size(); ++p) {
      const auto begin = idx(offsets[p]);
      const auto end = idx(offsets[p + 1]);
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t c = mirrored ? begin + end - 1 - k : k;
        const FbxCorner corner{c, idx(mesh.polygons.corners[c]), p};
        made_.mesh.corners.push_back(
            {-1, texture_of(textures, corner), normal_of(normals, corner, maps[corner.vertex])});
      }
      const std::int64_t row = materials.row_of({begin, 0, p});
      const double number = row < 0 ? 0 : materials.value(idx(row), 0);
      const bool is_there = number >= 0 && number < static_cast<double>(numbers.size());
      made_.mesh.material_of_face.push_back(is_there ? numbers[static_cast<std::size_t>(number)]
                                                     : -1);
    }
  }

  /// Channels of one name are one, as a face's and its teeth's.
  void add_shapes(const FbxMesh& mesh, const std::vector<Eigen::Matrix3d>& moving) {
    const Eigen::Index vertices = mesh.polygons.positions.rows();
    for (const FbxShape& shape : fbx_shapes(file_, scene_, mesh.geometry, vertices)) {
      const auto [entry, is_new] = shape_numbers_.try_emplace(shape.name, made_.mesh.shapes.size());
      if (is_new) made_.mesh.shapes.push_back({shape.name, {}});
      DressedShape& made = made_.mesh.shapes[entry->second];
      for (std::size_t k = 0; k < shape.vertices.size(); ++k) {
        const auto place =
            static_cast<std::int32_t>(first_vertex_) + static_cast<std::int32_t>(shape.vertices[k]);
        const Eigen::Vector3d move = moving[shape.vertices[k]] * shape.moves[k].transpose();
        if (move.allFinite()) made.moves[place] = move;
      }
    }
  }

  /// Of the model's materials, in their order, the numbers in all of the file.
  std::vector<int> materials_of(const FbxRecord& model) {
    std::vector<int> numbers;
    const FbxRecord* culling = model.child("Culling");
    const bool two_sided = culling != nullptr && culling->text(0) == "CullingOff";
    for (const FbxRecord* material : scene_.below(model, "Material")) {
      const auto [entry, is_new] =
          numbers_.try_emplace(material, static_cast<int>(made_.materials.size()));
      if (is_new) {
        made_.materials.push_back(fbx_look_of(file_, root_, scene_, *material));
        made_.mesh.materials.push_back(made_.materials.back().name);
      }
      made_.materials[idx(entry->second)].look->two_sided |= two_sided;
      numbers.push_back(entry->second);
    }
    return numbers;
  }

  /// Equal rows of a mesh are one.
  std::int32_t texture_of(const FbxLayer& layer, const FbxCorner& corner) {
    const std::int64_t row = layer.row_of(corner);
    if (row < 0) return -1;
    const std::array<float, 2> at{static_cast<float>(layer.value(idx(row), 0)),
                                  static_cast<float>(layer.value(idx(row), 1))};
    if (!std::isfinite(at[0]) || !std::isfinite(at[1])) return -1;
    const auto [entry, is_new] =
        texture_rows_.try_emplace(at, static_cast<std::int32_t>(made_.mesh.textures.size()));
    if (is_new) made_.mesh.textures.push_back(at);
    return entry->second;
  }

  /// Equal rows of a vertex are one.
  std::int32_t normal_of(const FbxLayer& layer, const FbxCorner& corner,
                         const Eigen::Matrix3d& map) {
    const std::int64_t row = layer.row_of(corner);
    if (row < 0) return -1;
    Eigen::Vector3d given;
    for (std::size_t k = 0; k < 3; ++k) {
      given[static_cast<Eigen::Index>(k)] = layer.value(idx(row), k);
    }
    if (!given.allFinite()) return -1;
    const Eigen::Vector3f normal = (map * given).normalized().cast<float>();
    const std::array<float, 3> turned{normal.x(), normal.y(), normal.z()};
    const auto [entry, is_new] = normal_rows_.try_emplace(
        std::tuple(corner.vertex, static_cast<float>(given.x()), static_cast<float>(given.y()),
                   static_cast<float>(given.z())),
        static_cast<std::int32_t>(made_.mesh.normals.size()));
    if (is_new) made_.mesh.normals.push_back(turned);
    return entry->second;
  }

  const FileBytes& file_;
  const FbxRecord& root_;
  const FbxScene& scene_;
  std::vector<std::string>& notes_;
  PlacedMeshes meshes_;
  DressedFile made_;
  std::map<const FbxRecord*, int> numbers_;                    // of materials
  std::map<std::array<float, 2>, std::int32_t> texture_rows_;  // of the mesh
  std::map<std::tuple<std::size_t, float, float, float>, std::int32_t> normal_rows_;  // likewise
  std::map<std::string, std::size_t> shape_numbers_;
  Eigen::Index first_vertex_ = 0;  // of the mesh
  bool has_colours_ = false;
  bool has_further_sets_ = false;
};

}  // namespace

std::optional<DressedFile> read_fbx_looks(const FileBytes& file, std::vector<std::string>& notes,
                                          const Monitor& monitor) {
  const FbxRecord root = parse_fbx(file);
  require_fbx_version(file, root);
  const FbxScene scene(file, root);
  return FbxLookReader(file, root, scene, notes, monitor).read();
}

}  // namespace curveskel
