#include "rig/fbx/fbx_mesh.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_set_names.hpp"
#include "rig/gltf/colours.hpp"
#include "rig/gltf/shown_colours.hpp"
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

/// FBX needs none that only show what pictures leave over.
bool has_shown_colours(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  return std::ranges::any_of(mesh.primitives, [&](const tinygltf::Primitive& primitive) {
    const auto found = primitive.attributes.find("COLOR_0");
    const bool has_triangles = primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
    return has_triangles && found != primitive.attributes.end() &&
           model.accessors[idx(found->second)].name == shown_colours;
  });
}

/// Of each corner the row of its vertex.
MeshRows by_corner(const MeshRows& rows, const std::vector<std::int32_t>& corners) {
  MeshRows result;
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
void write_shape(FbxRecords& records, const MeshRows& offsets) {
  std::vector<std::int32_t> vertices;
  MeshRows moves;
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
  records.record("Normals", MeshRows(moves.size(), 0));
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
                       records.record("FullWeights", MeshRows{percent});
                     });
    const std::int64_t form =
        document.add("Geometry", shape.name, "Geometry", "Shape",
                     [mesh, &shape](FbxRecords& records) { write_shape(records, shape.offsets); });
    geometry.sliders.push_back(channel);
    document.connect(channel, all);
    document.connect(form, channel);
  }
}

}  // namespace

FbxMesh read_fbx_mesh(const FileBytes& file, const tinygltf::Model& model, int mesh,
                      std::size_t joints, std::vector<std::string> map_names) {
  const tinygltf::Mesh& given = gltf_element(file, model.meshes, mesh, "mesh");
  FbxMesh made;
  const std::size_t first = has_shown_colours(model, given) ? 1 : 0;
  made.colour_names = fbx_set_names(model, given, {"COLOR_", "Color", first});
  const MeshSets sets{map_names.size(), made.colour_names.size(), first};
  static_cast<WholeMesh&>(made) = read_whole_mesh(file, model, mesh, joints, sets);
  made.map_names = std::move(map_names);
  for (MeshRows& colours : made.colours) {
    constexpr std::size_t opacity = 3;
    for (std::size_t k = 0; k < colours.size(); ++k) {
      if (k % 4 != opacity) colours[k] = srgb_from_linear(colours[k]);
    }
  }
  return made;
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
