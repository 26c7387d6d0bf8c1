#include "rig/gltf/whole_mesh.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_pose.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

/// The rows of one accessor, behind those of other primitives.
void append_rows(const FileBytes& file, const tinygltf::Model& model, int accessor, int components,
                 const std::string& meaning, MeshRows& rows) {
  const GltfNumbers numbers = gltf_numbers(file, model, accessor, components, meaning);
  for (std::size_t row = 0; row < numbers.rows(); ++row) {
    for (int k = 0; k < components; ++k) rows.push_back(numbers.at(row, idx(k)));
  }
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

std::vector<std::string> shape_names(const tinygltf::Mesh& mesh, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back("shape " + std::to_string(k + 1));
  if (!mesh.extras.Has("targetNames")) return names;
  const tinygltf::Value& given = mesh.extras.Get("targetNames");
  for (std::size_t k = 0; k < std::min(count, given.ArrayLen()); ++k) {
    const tinygltf::Value& name = given.Get(static_cast<int>(k));
    if (name.IsString()) names[k] = name.Get<std::string>();
  }
  return names;
}

bool has_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
}

class MeshReader {
 public:
  MeshReader(const FileBytes& file, const tinygltf::Model& model, const tinygltf::Mesh& mesh,
             std::size_t joints, const MeshSets& sets)
      : file_(file), model_(model), mesh_(mesh), first_colours_(sets.first_colours) {
    made_.moved.resize(joints);
    made_.maps.resize(sets.maps);
    made_.colours.resize(sets.colours);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!has_triangles(primitive)) continue;
      shapes_ = std::max(shapes_, primitive.targets.size());
      has_normals_ = has_normals_ && attribute(primitive, "NORMAL") >= 0;
    }
    const std::vector<std::string> names = shape_names(mesh, shapes_);
    for (std::size_t k = 0; k < shapes_; ++k) {
      made_.shapes.push_back({names[k], k < mesh.weights.size() ? mesh.weights[k] : 0, {}});
    }
  }

  WholeMesh read() {
    for (const tinygltf::Primitive& primitive : mesh_.primitives) {
      if (has_triangles(primitive)) add(primitive);
    }
    return std::move(made_);
  }

 private:
  static std::string map_attribute(std::size_t number) {
    return "TEXCOORD_" + std::to_string(number);
  }

  [[nodiscard]] std::string colour_attribute(std::size_t number) const {
    return "COLOR_" + std::to_string(number + first_colours_);
  }

  void add(const tinygltf::Primitive& primitive) {
    const auto [block, is_new] = blocks_.try_emplace(
        std::pair(primitive.attributes, primitive.targets), made_.places.size() / 3);
    if (is_new) add_vertices(primitive);
    const std::int32_t material = material_number(primitive.material);
    made_.material_of_primitive.push_back(material);
    for (const auto& [a, b, c] : triangles(primitive)) {
      for (const std::size_t corner : {a, b, c}) {
        made_.corners.push_back(static_cast<std::int32_t>(block->second + corner));
      }
      made_.offsets.push_back(static_cast<std::int64_t>(made_.corners.size()));
      made_.material_of_face.push_back(material);
    }
  }

  void add_vertices(const tinygltf::Primitive& primitive) {
    const std::size_t first = made_.places.size() / 3;
    append_rows(file_, model_, attribute(primitive, "POSITION"), 3, "positions", made_.places);
    const std::size_t count = made_.places.size() / 3;
    if (has_normals_) {
      append_rows(file_, model_, attribute(primitive, "NORMAL"), 3, "normals", made_.normals);
      made_.normals.resize(3 * count, 0);
    }
    for (std::size_t k = 0; k < made_.maps.size(); ++k) {
      MeshRows& map = made_.maps[k];
      const int accessor = attribute(primitive, map_attribute(k));
      if (accessor >= 0) append_rows(file_, model_, accessor, 2, "texture coordinates", map);
      map.resize(2 * count, 0);
      for (std::size_t v = first; v < count; ++v) map[2 * v + 1] = 1 - map[2 * v + 1];
    }
    for (std::size_t k = 0; k < made_.colours.size(); ++k) add_colours(primitive, k, count);
    for (std::size_t k = 0; k < shapes_; ++k) {
      MeshRows& offsets = made_.shapes[k].offsets;
      if (k < primitive.targets.size()) {
        const auto found = primitive.targets[k].find("POSITION");
        if (found != primitive.targets[k].end()) {
          append_rows(file_, model_, found->second, 3, "shape keys", offsets);
        }
      }
      offsets.resize(3 * count, 0);
    }
    if (made_.moved.empty()) return;
    made_.first_joint.resize(count, -1);
    for_each_weight(file_, model_, primitive, made_.moved.size(),
                    [&](std::size_t vertex, std::size_t joint, double weight) {
                      std::int32_t& named = made_.first_joint[first + vertex];
                      if (named < 0) named = static_cast<std::int32_t>(joint);
                      if (weight <= 0) return;
                      made_.moved[joint].emplace_back(static_cast<std::int32_t>(first + vertex),
                                                      weight);
                    });
  }

  void add_colours(const tinygltf::Primitive& primitive, std::size_t set, std::size_t count) {
    MeshRows& colours = made_.colours[set];
    const int accessor = attribute(primitive, colour_attribute(set));
    if (accessor >= 0) {
      const bool is_opaque = model_.accessors[idx(accessor)].type == TINYGLTF_TYPE_VEC3;
      const std::size_t width = is_opaque ? 3 : 4;
      MeshRows rows;
      append_rows(file_, model_, accessor, static_cast<int>(width), "colours", rows);
      for (std::size_t row = 0; row < rows.size() / width; ++row) {
        for (std::size_t k = 0; k < 4; ++k) {
          const double given = k < width ? rows[row * width + k] : 1;
          colours.push_back(given);
        }
      }
    }
    colours.resize(4 * count, 1);
  }

  std::int32_t material_number(int material) {
    const auto found = std::find(made_.materials.begin(), made_.materials.end(), material);
    const auto number = static_cast<std::int32_t>(found - made_.materials.begin());
    if (found == made_.materials.end()) made_.materials.push_back(material);
    return number;
  }

  [[nodiscard]] std::vector<std::array<std::size_t, 3>> triangles(
      const tinygltf::Primitive& primitive) const {
    std::vector<std::size_t> corners;
    if (primitive.indices >= 0) {
      const GltfNumbers numbers = gltf_numbers(file_, model_, primitive.indices, 1, "corners");
      for (std::size_t row = 0; row < numbers.rows(); ++row) {
        corners.push_back(static_cast<std::size_t>(numbers.at(row, 0)));
      }
    } else {
      const int accessor = attribute(primitive, "POSITION");
      const std::size_t count = gltf_numbers(file_, model_, accessor, 3, "positions").rows();
      for (std::size_t v = 0; v < count; ++v) corners.push_back(v);
    }
    std::vector<std::array<std::size_t, 3>> found;
    for (std::size_t k = 0; k < gltf_triangle_count(primitive.mode, corners.size()); ++k) {
      const auto [a, b, c] = gltf_triangle(primitive.mode, k);
      found.push_back({corners[a], corners[b], corners[c]});
    }
    return found;
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const tinygltf::Mesh& mesh_;
  std::size_t first_colours_;
  std::size_t shapes_ = 0;
  bool has_normals_ = true;
  std::map<std::pair<std::map<std::string, int>, std::vector<std::map<std::string, int>>>,
           std::size_t>
      blocks_;  // where vertices of these attributes begin
  WholeMesh made_;
};

void move_rows(MeshRows& rows, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift) {
  for (std::size_t k = 0; k + 2 < rows.size(); k += 3) {
    Eigen::Map<Eigen::Vector3d> row(rows.data() + k);
    row = (linear * row + shift).eval();
  }
}

}  // namespace

MeshSets sets_of(const tinygltf::Mesh& mesh) {
  const auto count = [&](const std::string& name) {
    std::size_t number = 0;
    const auto has_set = [&](const tinygltf::Primitive& primitive) {
      return has_triangles(primitive) && attribute(primitive, name + std::to_string(number)) >= 0;
    };
    while (std::ranges::any_of(mesh.primitives, has_set)) ++number;
    return number;
  };
  return {count("TEXCOORD_"), count("COLOR_"), 0};
}

WholeMesh read_whole_mesh(const FileBytes& file, const tinygltf::Model& model, int mesh,
                          std::size_t joints, const MeshSets& sets) {
  return MeshReader(file, model, gltf_element(file, model.meshes, mesh, "mesh"), joints, sets)
      .read();
}

void take_polygons(WholeMesh& mesh, const MeshPolygons& polygons) {
  mesh.place_of_vertex = polygons.place_of_vertex;
  mesh.places.resize(3 * polygons.places);
  for (WholeMesh::Shape& shape : mesh.shapes) shape.offsets.resize(3 * polygons.places);
  for (auto& vertices : mesh.moved) {
    std::erase_if(vertices, [&](const auto& one) { return idx(one.first) >= polygons.places; });
  }
  if (!mesh.first_joint.empty()) mesh.first_joint.resize(polygons.places);
  mesh.corners = polygons.corners;
  mesh.offsets = polygons.offsets;
  mesh.material_of_face.clear();
  for (const std::size_t primitive : polygons.primitive_of_face) {
    mesh.material_of_face.push_back(mesh.material_of_primitive.at(primitive));
  }
}

void move(WholeMesh& mesh, const Eigen::Affine3d& frame) {
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  move_rows(mesh.places, frame.linear(), frame.translation());
  for (WholeMesh::Shape& shape : mesh.shapes) move_rows(shape.offsets, frame.linear(), nowhere);
  const double volume = frame.linear().determinant();
  if (volume == 0) return;
  move_rows(mesh.normals, frame.linear().inverse().transpose(), nowhere);
  for (std::size_t k = 0; k + 2 < mesh.normals.size(); k += 3) {
    Eigen::Map<Eigen::Vector3d> normal(mesh.normals.data() + k);
    normal.normalize();
  }
  if (volume > 0) return;
  for (std::size_t face = 0; face + 1 < mesh.offsets.size(); ++face) {
    const auto begin = mesh.corners.begin();
    std::reverse(begin + mesh.offsets[face] + 1, begin + mesh.offsets[face + 1]);
  }
}

}  // namespace curveskel
