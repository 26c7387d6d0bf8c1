#include "rig/fbx/fbx_mesh.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_set_names.hpp"
#include "rig/gltf/colours.hpp"
#include "rig/gltf/shown_colours.hpp"
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_pose.hpp"

namespace curveskel {
namespace {

/// The rows of one accessor, behind those of other primitives.
void append_rows(const FileBytes& file, const tinygltf::Model& model, int accessor, int components,
                 const std::string& meaning, FbxRows& rows) {
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
             std::size_t joints, std::vector<std::string> map_names)
      : file_(file), model_(model), mesh_(mesh) {
    made_.moved.resize(joints);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!has_triangles(primitive)) continue;
      shapes_ = std::max(shapes_, primitive.targets.size());
      const int first = attribute(primitive, "COLOR_0");
      if (first >= 0 && model_.accessors[idx(first)].name == shown_colours) first_colours_ = 1;
      has_normals_ = has_normals_ && attribute(primitive, "NORMAL") >= 0;
    }
    made_.map_names = std::move(map_names);
    made_.maps.resize(made_.map_names.size());
    made_.colour_names = fbx_set_names(model, mesh, {"COLOR_", "Color", first_colours_});
    made_.colours.resize(made_.colour_names.size());
    const std::vector<std::string> names = shape_names(mesh, shapes_);
    for (std::size_t k = 0; k < shapes_; ++k) {
      made_.shapes.push_back({names[k], k < mesh.weights.size() ? mesh.weights[k] : 0, {}});
    }
  }

  FbxMesh read() {
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
      FbxRows& map = made_.maps[k];
      const int accessor = attribute(primitive, map_attribute(k));
      if (accessor >= 0) append_rows(file_, model_, accessor, 2, "texture coordinates", map);
      map.resize(2 * count, 0);
      for (std::size_t v = first; v < count; ++v) map[2 * v + 1] = 1 - map[2 * v + 1];
    }
    for (std::size_t k = 0; k < made_.colours.size(); ++k) add_colours(primitive, k, count);
    for (std::size_t k = 0; k < shapes_; ++k) {
      FbxRows& offsets = made_.shapes[k].offsets;
      if (k < primitive.targets.size()) {
        const auto found = primitive.targets[k].find("POSITION");
        if (found != primitive.targets[k].end()) {
          append_rows(file_, model_, found->second, 3, "shape keys", offsets);
        }
      }
      offsets.resize(3 * count, 0);
    }
    if (made_.moved.empty()) return;
    for_each_weight(file_, model_, primitive, made_.moved.size(),
                    [&](std::size_t vertex, std::size_t joint, double weight) {
                      if (weight <= 0) return;
                      made_.moved[joint].emplace_back(static_cast<std::int32_t>(first + vertex),
                                                      weight);
                    });
  }

  void add_colours(const tinygltf::Primitive& primitive, std::size_t set, std::size_t count) {
    FbxRows& colours = made_.colours[set];
    const int accessor = attribute(primitive, colour_attribute(set));
    if (accessor >= 0) {
      const bool is_opaque = model_.accessors[idx(accessor)].type == TINYGLTF_TYPE_VEC3;
      const std::size_t width = is_opaque ? 3 : 4;
      FbxRows rows;
      append_rows(file_, model_, accessor, static_cast<int>(width), "colours", rows);
      for (std::size_t row = 0; row < rows.size() / width; ++row) {
        for (std::size_t k = 0; k < 4; ++k) {
          const double given = k < width ? rows[row * width + k] : 1;
          constexpr std::size_t opacity = 3;
          colours.push_back(k == opacity ? given : srgb_from_linear(given));
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
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    const bool is_fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::size_t step = is_strip || is_fan ? 1 : 3;
    for (std::size_t k = 0; k + 2 < corners.size(); k += step) {
      if (is_fan) {
        found.push_back({corners[0], corners[k + 1], corners[k + 2]});
      } else {
        const std::size_t turned = is_strip ? k % 2 : 0;
        found.push_back({corners[k + turned], corners[k + 1 - turned], corners[k + 2]});
      }
    }
    return found;
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const tinygltf::Mesh& mesh_;
  std::size_t first_colours_ = 0;  // FBX needs none that only show what pictures leave over
  std::size_t shapes_ = 0;
  bool has_normals_ = true;
  std::map<std::pair<std::map<std::string, int>, std::vector<std::map<std::string, int>>>,
           std::size_t>
      blocks_;  // where vertices of these attributes begin
  FbxMesh made_;
};

/// Of each corner the row of its vertex.
FbxRows by_corner(const FbxRows& rows, const std::vector<std::int32_t>& corners) {
  FbxRows result;
  result.reserve(3 * corners.size());
  for (const std::int32_t corner : corners) {
    for (std::size_t k = 0; k < 3; ++k) result.push_back(rows[3 * idx(corner) + k]);
  }
  return result;
}

/// A polygon's last corner is told by its sign.
std::vector<std::int32_t> signed_polygons(const FbxMesh& mesh) {
  std::vector<std::int32_t> corners = mesh.corners;
  if (!mesh.place_of_vertex.empty()) {
    for (std::int32_t& corner : corners) corner = mesh.place_of_vertex[idx(corner)];
  }
  for (std::size_t face = 1; face < mesh.offsets.size(); ++face) {
    std::int32_t& last = corners[idx(mesh.offsets[face] - 1)];
    last = -last - 1;
  }
  return corners;
}

void begin_layer(FbxRecords& records, const char* type, std::int32_t number,
                 const std::string& name, const char* by, const char* reference) {
  records.begin(type);
  records.add(number);
  records.record("Version", 101);
  records.record("Name", name);
  records.record("MappingInformationType", by);
  records.record("ReferenceInformationType", reference);
}

using LayerElements = std::vector<std::pair<const char*, std::int32_t>>;

void write_layer(FbxRecords& records, std::int32_t number, const LayerElements& elements) {
  records.begin("Layer");
  records.add(number);
  records.record("Version", 100);
  for (const auto& [type, index] : elements) {
    records.begin("LayerElement");
    records.record("Type", type);
    records.record("TypedIndex", index);
    records.end();
  }
  records.end();
}

/// The first layer has `first`, each a set of colours and one of texture coordinates.
void write_layers(FbxRecords& records, const FbxMesh& mesh, LayerElements first) {
  const std::size_t sets = std::max(mesh.maps.size(), mesh.colours.size());
  for (std::size_t k = 0; k < std::max<std::size_t>(1, sets); ++k) {
    const auto number = static_cast<std::int32_t>(k);
    LayerElements layer = std::exchange(first, {});
    if (k < mesh.colours.size()) layer.emplace_back("LayerElementColor", number);
    if (k < mesh.maps.size()) layer.emplace_back("LayerElementUV", number);
    write_layer(records, number, layer);
  }
}

void write_geometry(FbxRecords& records, const FbxMesh& mesh) {
  records.record("GeometryVersion", 124);
  records.record("Vertices", mesh.places);
  records.record("PolygonVertexIndex", signed_polygons(mesh));
  LayerElements layer;
  if (mesh.has_materials()) layer.emplace_back("LayerElementMaterial", 0);
  if (!mesh.normals.empty()) {
    begin_layer(records, "LayerElementNormal", 0, "", "ByPolygonVertex", "Direct");
    records.record("Normals", by_corner(mesh.normals, mesh.corners));
    records.end();
    layer.emplace_back("LayerElementNormal", 0);
  }
  for (std::size_t k = 0; k < mesh.colours.size(); ++k) {
    begin_layer(records, "LayerElementColor", static_cast<std::int32_t>(k), mesh.colour_names[k],
                "ByPolygonVertex", "IndexToDirect");
    records.record("Colors", mesh.colours[k]);
    records.record("ColorIndex", mesh.corners);
    records.end();
  }
  for (std::size_t k = 0; k < mesh.maps.size(); ++k) {
    begin_layer(records, "LayerElementUV", static_cast<std::int32_t>(k), mesh.map_names[k],
                "ByPolygonVertex", "IndexToDirect");
    records.record("UV", mesh.maps[k]);
    records.record("UVIndex", mesh.corners);
    records.end();
  }
  if (mesh.has_materials()) {
    begin_layer(records, "LayerElementMaterial", 0, "", "ByPolygon", "IndexToDirect");
    records.record("Materials", mesh.material_of_face);
    records.end();
  }
  write_layers(records, mesh, std::move(layer));
}

/// The vertices that the shape moves, and how far.
void write_shape(FbxRecords& records, const FbxRows& offsets) {
  std::vector<std::int32_t> vertices;
  FbxRows moves;
  for (std::size_t v = 0; v < offsets.size() / 3; ++v) {
    const auto first = offsets.begin() + std::ptrdiff_t(3 * v);
    const bool moves_it = std::any_of(first, first + 3, [](double x) { return x != 0; });
    if (!moves_it && v > 0) continue;  // a shape has one vertex at least
    vertices.push_back(static_cast<std::int32_t>(v));
    moves.insert(moves.end(), first, first + 3);
  }
  records.record("Version", 100);
  records.record("Indexes", vertices);
  records.record("Vertices", moves);
  records.record("Normals", FbxRows(moves.size(), 0));
}

void add_shapes(FbxDocument& document, FbxGeometry& geometry,
                const std::shared_ptr<const FbxMesh>& mesh, const std::string& name) {
  if (mesh->shapes.empty()) return;
  const std::int64_t all =
      document.add("Deformer", name, "Deformer", "BlendShape",
                   [](FbxRecords& records) { records.record("Version", 100); });
  document.connect(all, geometry.number);
  constexpr double percent = 100;
  for (const FbxMesh::Shape& shape : mesh->shapes) {  // stays where it is as long as the mesh
    const std::int64_t channel =
        document.add("Deformer", shape.name, "SubDeformer", "BlendShapeChannel",
                     [mesh, &shape](FbxRecords& records) {
                       records.record("Version", 100);
                       records.record("DeformPercent", percent * shape.weight);
                       records.record("FullWeights", FbxRows{percent});
                     });
    const std::int64_t form =
        document.add("Geometry", shape.name, "Geometry", "Shape",
                     [mesh, &shape](FbxRecords& records) { write_shape(records, shape.offsets); });
    geometry.sliders.push_back(channel);
    document.connect(channel, all);
    document.connect(form, channel);
  }
}

void move_rows(FbxRows& rows, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift) {
  for (std::size_t k = 0; k + 2 < rows.size(); k += 3) {
    Eigen::Map<Eigen::Vector3d> row(rows.data() + k);
    row = (linear * row + shift).eval();
  }
}

}  // namespace

FbxMesh read_fbx_mesh(const FileBytes& file, const tinygltf::Model& model, int mesh,
                      std::size_t joints, std::vector<std::string> map_names) {
  return MeshReader(file, model, gltf_element(file, model.meshes, mesh, "mesh"), joints,
                    std::move(map_names))
      .read();
}

void take_polygons(FbxMesh& mesh, const MeshPolygons& polygons) {
  mesh.place_of_vertex = polygons.place_of_vertex;
  mesh.places.resize(3 * polygons.places);
  for (FbxMesh::Shape& shape : mesh.shapes) shape.offsets.resize(3 * polygons.places);
  for (auto& vertices : mesh.moved) {
    std::erase_if(vertices, [&](const auto& one) { return idx(one.first) >= polygons.places; });
  }
  mesh.corners = polygons.corners;
  mesh.offsets = polygons.offsets;
  mesh.material_of_face.clear();
  for (const std::size_t primitive : polygons.primitive_of_face) {
    mesh.material_of_face.push_back(mesh.material_of_primitive.at(primitive));
  }
}

void move(FbxMesh& mesh, const Eigen::Affine3d& frame) {
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  move_rows(mesh.places, frame.linear(), frame.translation());
  for (FbxMesh::Shape& shape : mesh.shapes) move_rows(shape.offsets, frame.linear(), nowhere);
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

FbxGeometry add_fbx_geometry(FbxDocument& document, const std::string& name, FbxMesh mesh) {
  const auto shared = std::make_shared<const FbxMesh>(std::move(mesh));
  FbxGeometry geometry;
  geometry.number =
      document.add("Geometry", name, "Geometry", "Mesh",
                   [shared](FbxRecords& records) { write_geometry(records, *shared); });
  add_shapes(document, geometry, shared, name);
  return geometry;
}

}  // namespace curveskel
