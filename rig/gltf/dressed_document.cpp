#include "rig/gltf/dressed_document.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/clean.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/dressed_materials.hpp"
#include "rig/gltf/number_bytes.hpp"
#include "rig/gltf/seam_normals.hpp"
#include "rig/gltf/shown_colours.hpp"
#include "rig/gltf/split_mesh.hpp"
#include "surface/mesh/single_precision.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

std::size_t add_normals(GltfDocument& document, const DressedMesh& mesh, const SplitMesh& split,
                        const Positions& computed) {
  std::string rows;
  for (std::size_t v = 0; v < split.vertices.size(); ++v) {
    Eigen::RowVector3d normal = computed.row(static_cast<Eigen::Index>(v));
    const std::int32_t given = split.vertices[v].normal;
    if (given >= 0) {
      const auto& said = mesh.normals[idx(given)];
      const Eigen::RowVector3d direction =
          Eigen::RowVector3f(said[0], said[1], said[2]).cast<double>();
      if (direction.allFinite() && direction.norm() > 0) normal = direction.normalized();
    }
    for (const double number : normal) put_number(rows, static_cast<float>(number));
  }
  return add_accessor(document, rows, "VEC3", gltf_float, split.vertices.size(), gltf_vertices);
}

std::size_t add_colours(GltfDocument& document, const DressedMesh& mesh, const SplitMesh& split,
                        std::size_t set) {
  std::string rows;
  for (const DressedCorner& vertex : split.vertices) {
    for (std::size_t k = 4 * set; k < 4 * set + 4; ++k) {
      put_number(rows, vertex.colour < 0 ? 1 : mesh.colours[idx(vertex.colour)][k]);
    }
  }
  return add_accessor(document, rows, "VEC4", gltf_float, split.vertices.size(), gltf_vertices);
}

/// Rows count from the picture's upper edge, as glTF wants them.
std::size_t add_textures(GltfDocument& document, const DressedMesh& mesh, const SplitMesh& split,
                         std::size_t set) {
  std::string rows;
  for (const DressedCorner& vertex : split.vertices) {
    std::array<float, 2> at{0, 1};
    if (vertex.texture >= 0) {
      const TextureRow& row = mesh.textures[idx(vertex.texture)];
      at = {row[2 * set], row[2 * set + 1]};
    }
    put_number(rows, std::isfinite(at[0]) ? at[0] : 0);
    put_number(rows, std::isfinite(at[1]) ? 1 - at[1] : 0);
  }
  return add_accessor(document, rows, "VEC2", gltf_float, split.vertices.size(), gltf_vertices);
}

/// The moves of a shape, sparse: of those that are none nothing is written.
std::size_t add_shape(GltfDocument& document, const DressedShape& shape, const SplitMesh& split) {
  std::string rows;
  std::string moves;
  std::size_t count = 0;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Eigen::Vector3f low = Eigen::Vector3f::Constant(infinity);
  Eigen::Vector3f high = Eigen::Vector3f::Constant(-infinity);
  for (std::size_t v = 0; v < split.vertices.size(); ++v) {
    const auto found = shape.moves.find(split.vertices[v].place);
    if (found == shape.moves.end()) continue;
    const Eigen::Vector3f move = found->second.cast<float>();
    put_number(rows, static_cast<std::uint32_t>(v));
    for (const float number : move) put_number(moves, number);
    low = low.cwiseMin(move);
    high = high.cwiseMax(move);
    ++count;
  }
  if (count == 0 || count < split.vertices.size()) {  // those that stay move by nothing
    low = low.cwiseMin(0.0F);
    high = high.cwiseMax(0.0F);
  }
  OrderedJson accessor{{"componentType", gltf_float},
                       {"count", split.vertices.size()},
                       {"type", "VEC3"},
                       {"min", {low.x(), low.y(), low.z()}},
                       {"max", {high.x(), high.y(), high.z()}}};
  if (count > 0) {
    accessor["sparse"] = {
        {"count", count},
        {"indices", {{"bufferView", add_view(document, rows)}, {"componentType", gltf_uint32}}},
        {"values", {{"bufferView", add_view(document, moves)}}}};
  }
  OrderedJson& accessors = array_in(document.json, "accessors");
  accessors.push_back(std::move(accessor));
  return accessors.size() - 1;
}

/// By material, whether it has one for its base colour.
std::vector<bool> with_pictures(const GltfDocument& document, std::size_t materials) {
  std::vector<bool> result(materials, false);
  for (std::size_t k = 0; k < materials; ++k) {
    const OrderedJson& material = document.json["materials"][k];
    result[k] = material.contains("pbrMetallicRoughness") &&
                material["pbrMetallicRoughness"].contains("baseColorTexture");
  }
  return result;
}

/// By group.
std::vector<Triangles> triangles_of(const SplitMesh& split) {
  PolygonSoup soup;
  soup.positions = split.soup.positions;
  std::vector<Triangles> groups;
  for (std::size_t group = 0; group < split.corners.size(); ++group) {
    soup.corners = split.corners[group];
    soup.offsets = split.offsets[group];
    groups.push_back(triangulate(soup));
  }
  return groups;
}

std::size_t add_triangles(GltfDocument& document, const Triangles& triangles) {
  std::string rows;
  for (const auto& triangle : triangles.rowwise()) {
    for (const int vertex : triangle) put_number(rows, static_cast<std::uint32_t>(vertex));
  }
  return add_accessor(document, rows, "SCALAR", gltf_uint32, idx(triangles.size()), gltf_indices);
}

Eigen::Index triangle_count(const std::vector<Triangles>& groups) {
  Eigen::Index rows = 0;
  for (const Triangles& triangles : groups) rows += triangles.rows();
  return rows;
}

Positions normals_of(const SplitMesh& split, const std::vector<Triangles>& groups) {
  Surface whole{split.soup.positions, Triangles(triangle_count(groups), 3)};
  Eigen::Index filled = 0;
  for (const Triangles& triangles : groups) {
    whole.triangles.middleRows(filled, triangles.rows()) = triangles;
    filled += triangles.rows();
  }
  return normals_across_seams(whole);
}

/// Sets of texture coordinates that the materials of these faces name.
std::size_t sets_shown(const GltfDocument& document, const DressedMesh& mesh,
                       const SplitMesh& split, const std::vector<Triangles>& groups) {
  std::size_t sets = 0;
  const auto take = [&](const OrderedJson& owner, const char* name) {
    if (owner.contains(name)) sets = std::max(sets, owner[name].value("texCoord", 0UL) + 1);
  };
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (groups[group].rows() == 0 || split.materials[group] >= mesh.materials.size()) continue;
    const OrderedJson& material = document.json["materials"][split.materials[group]];
    take(material, "normalTexture");
    take(material, "emissiveTexture");
    if (material.contains("pbrMetallicRoughness")) {
      take(material["pbrMetallicRoughness"], "baseColorTexture");
    }
  }
  return sets;
}

void name_accessor(GltfDocument& document, std::size_t accessor, const std::string& name) {
  if (!name.empty()) document.json["accessors"][accessor]["name"] = as_utf8(name);
}

/// All accessors that the primitives of a part share.
OrderedJson attributes_of(GltfDocument& document, const DressedMesh& mesh, const DressedPart& part,
                          const SplitMesh& split, const std::vector<Triangles>& groups) {
  OrderedJson attributes{
      {"POSITION", add_places(document, split.soup.positions.transpose().cast<float>())}};
  attributes["NORMAL"] = add_normals(document, mesh, split, normals_of(split, groups));
  const std::size_t maps =
      std::max(part.texture_sets.size(), sets_shown(document, mesh, split, groups));
  for (std::size_t set = 0; !mesh.textures.empty() && set < maps; ++set) {
    const std::size_t textures = add_textures(document, mesh, split, set);
    attributes["TEXCOORD_" + std::to_string(set)] = textures;
    if (set < part.texture_sets.size()) {
      name_accessor(document, textures, part.texture_sets[set]);
    }
  }
  for (std::size_t set = 0; !mesh.colours.empty() && set < part.colour_sets.size(); ++set) {
    const std::size_t colours = add_colours(document, mesh, split, set);
    attributes["COLOR_" + std::to_string(set)] = colours;
    name_accessor(document, colours, part.colour_sets[set]);
  }
  return attributes;
}

/// The targets of the part's shapes, which get names and sliders in it.
OrderedJson targets_of(GltfDocument& document, const DressedMesh& mesh, const PartRange& part,
                       const SplitMesh& split, OrderedJson& written) {
  OrderedJson targets = OrderedJson::array();
  for (const DressedShape& shape : mesh.shapes) {
    if (shape.part != part.number) continue;
    targets.push_back({{"POSITION", add_shape(document, shape, split)}});
    array_in(written, "weights").push_back(shape.weight);
    written["extras"]["targetNames"].push_back(as_utf8(shape.name));
  }
  return targets;
}

/// Without those of one or two corners; `groups` with triangles are primitives.
MeshPolygons polygons_of(const SplitMesh& split, std::size_t places,
                         const std::vector<Triangles>& groups) {
  MeshPolygons mesh{places, split.place_of_vertex, {}, {0}, {}};
  std::vector<std::size_t> primitive_of_group;
  std::size_t primitives = 0;
  for (const Triangles& triangles : groups) {
    primitive_of_group.push_back(primitives);
    if (triangles.rows() > 0) ++primitives;
  }
  std::vector<std::size_t> next(groups.size(), 0);  // the group's polygon
  for (const std::size_t group : split.group_of_face) {
    const std::int64_t* ends = split.offsets[group].data() + next[group]++;
    if (ends[1] - ends[0] < 3) continue;
    const auto begin = split.corners[group].begin();
    mesh.corners.insert(mesh.corners.end(), begin + ends[0], begin + ends[1]);
    mesh.offsets.push_back(static_cast<std::int64_t>(mesh.corners.size()));
    mesh.primitive_of_face.push_back(primitive_of_group[group]);
  }
  return mesh;
}

/// A node with a mesh, a primitive for each material; nothing of a part without faces.
void add_part(DressedDocument& made, const DressedMesh& mesh, const PartRange& part,
              const FileBytes& file) {
  GltfDocument& document = made.document;
  const SplitMesh split = curveskel::split(mesh, part, file);
  require_single_precision(split.soup.positions, "glTF");
  const std::vector<Triangles> groups = triangles_of(split);
  if (triangle_count(groups) == 0 && mesh.parts.size() > 1) return;
  const auto first_vertex = static_cast<std::int64_t>(made.row_of_vertex.size());
  for (const DressedCorner& vertex : split.vertices) made.row_of_vertex.push_back(vertex.place);
  OrderedJson written{{"name", as_utf8(part.part.name)}};
  const OrderedJson attributes = attributes_of(document, mesh, part.part, split, groups);
  const OrderedJson targets = targets_of(document, mesh, part, split, written);
  const auto number = static_cast<int>(array_in(document.json, "meshes").size());
  OrderedJson primitives = OrderedJson::array();
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (groups[group].rows() == 0) continue;
    OrderedJson primitive{{"attributes", attributes},
                          {"indices", add_triangles(document, groups[group])}};
    const std::size_t material = split.materials[group];
    if (material < mesh.materials.size()) primitive["material"] = material;
    if (!targets.empty()) primitive["targets"] = targets;
    made.parts.push_back({number, number, static_cast<int>(primitives.size()), true, first_vertex,
                          split.soup.positions.rows(), mesh.to_gltf});
    primitives.push_back(std::move(primitive));
  }
  written["primitives"] = std::move(primitives);
  made.polygons.push_back(polygons_of(split, part.places.size(), groups));
  array_in(document.json, "meshes").push_back(std::move(written));
  array_in(document.json, "nodes").push_back({{"name", as_utf8(part.part.name)}, {"mesh", number}});
  array_in(document.json["scenes"][0], "nodes").push_back(number);
  made.node_of_part[part.number] = number;
}

}  // namespace

DressedDocument dressed_document(DressedMesh mesh, const std::vector<DressedMaterial>& materials,
                                 const FileBytes& file, const std::string& name,
                                 std::vector<std::string>& notes, const Monitor& monitor) {
  DressedDocument made;
  GltfDocument& document = made.document;
  document.json = {{"asset", {{"version", "2.0"}}},
                   {"scene", 0},
                   {"scenes", OrderedJson::array({OrderedJson::object()})},
                   {"nodes", OrderedJson::array()},
                   {"meshes", OrderedJson::array()},
                   {"buffers", OrderedJson::array({OrderedJson::object()})}};
  add_materials(document, materials, notes, monitor);
  if (mesh.parts.empty()) mesh.parts.push_back({name, 0, 0, {""}, {""}});
  for (DressedPart& part : mesh.parts) {
    if (part.name.empty()) part.name = name;
  }
  made.node_of_part.assign(mesh.parts.size(), -1);
  show_colours(mesh, with_pictures(document, materials.size()));
  for (const PartRange& part : ranges_of(mesh)) add_part(made, mesh, part, file);
  return made;
}

}  // namespace curveskel
