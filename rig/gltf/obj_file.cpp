#include "rig/gltf/obj_file.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/colours.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

/// -1 where it is none of those so far or to come; counted from 1, or from -1 backwards.
std::int32_t index_from_zero(std::int64_t number, std::size_t so_far) {
  const std::int64_t index = number < 0 ? static_cast<std::int64_t>(so_far) + number : number - 1;
  return index < 0 || index >= most_vertices ? -1 : static_cast<std::int32_t>(index);
}

bool is_number(const TextCursor& text) {
  const char c = text.peek();
  return c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9');
}

/// v, v/vt, v//vn or v/vt/vn.
DressedCorner read_corner(TextCursor& text, const DressedMesh& mesh) {
  DressedCorner corner;
  corner.place = index_from_zero(text.integer("a vertex index"), mesh.places.size() / 3);
  if (text.peek() != '/') return corner;
  text.skip(1);
  if (is_number(text)) {
    corner.texture = index_from_zero(text.integer("an index"), mesh.textures.size());
  }
  if (text.peek() != '/') return corner;
  text.skip(1);
  if (is_number(text))
    corner.normal = index_from_zero(text.integer("an index"), mesh.normals.size());
  return corner;
}

void read_face(TextCursor& text, DressedMesh& mesh, int material) {
  for (text.skip_blanks(); !text.at_line_end() && text.peek() != '#'; text.skip_blanks()) {
    mesh.corners.push_back(read_corner(text, mesh));
    text.word();
  }
  mesh.offsets.push_back(static_cast<std::int64_t>(mesh.corners.size()));
  mesh.material_of_face.push_back(material);
}

/// The rest of the line, blanks within it kept: names may have them.
std::string rest_of_line(TextCursor& text) {
  std::string rest;
  for (text.skip_blanks(); !text.at_line_end(); text.skip(1)) rest += text.peek();
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\r' || rest.back() == '\t')) {
    rest.pop_back();
  }
  return rest;
}

template <std::size_t Count>
std::array<float, Count> read_numbers(TextCursor& text) {
  std::array<float, Count> numbers{};
  for (float& number : numbers) {
    text.skip_blanks();
    if (text.at_line_end()) break;
    number = static_cast<float>(text.coordinate("a number"));
  }
  return numbers;
}

/// "v x y z r g b", as scanners' programs write; a fourth coordinate alone is no colour.
void read_colour(TextCursor& text, DressedMesh& mesh) {
  std::array<double, 3> colour{};
  std::size_t count = 0;
  for (text.skip_blanks(); count < colour.size() && is_number(text); text.skip_blanks()) {
    colour[count++] = text.coordinate("a colour");
  }
  if (count < colour.size()) return;
  mesh.colours.resize(mesh.places.size() / 3 - 1, {1, 1, 1, 1});
  const auto [r, g, b, a] = linear_colour({colour[0], colour[1], colour[2], 1});
  mesh.colours.push_back({r, g, b, a});
}

/// The object of this name has the places and faces to come.
void begin_object(const std::string& name, DressedMesh& mesh) {
  if (!mesh.parts.empty() && mesh.parts.back().name == name) return;
  mesh.parts.push_back({name, mesh.places.size() / 3, mesh.material_of_face.size()});
}

/// Objects without faces go; each other has the sets that its corners name.
void finish_objects(DressedMesh& mesh) {
  std::vector<DressedPart> objects;
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    DressedPart& object = mesh.parts[k];
    const std::size_t end_face =
        k + 1 < mesh.parts.size() ? mesh.parts[k + 1].first_face : mesh.material_of_face.size();
    if (object.first_face == end_face) continue;
    if (std::any_of(mesh.corners.begin() + mesh.offsets[object.first_face],
                    mesh.corners.begin() + mesh.offsets[end_face],
                    [](const DressedCorner& corner) { return corner.texture >= 0; })) {
      object.texture_sets = {""};
    }
    if (!mesh.colours.empty()) object.colour_sets = {""};
    objects.push_back(std::move(object));
  }
  mesh.parts = std::move(objects);
}

}  // namespace

ObjFile read_obj_file(const FileBytes& file, const Monitor& monitor) {
  ObjFile obj;
  DressedMesh& mesh = obj.mesh;
  int material = -1;
  std::map<std::string, int> number_of_material;
  begin_object("", mesh);
  TextCursor text(file);
  for (std::int64_t row = 0; !text.done(); ++row) {
    if (row % rows_per_report == 0) monitor.report("write", text.fraction());
    text.skip_blanks();
    if (text.accept("v")) {
      text.read_vertex(mesh.places);
      read_colour(text, mesh);
    } else if (text.accept("vt")) {
      const auto [u, v] = read_numbers<2>(text);
      mesh.textures.push_back({u, v});
    } else if (text.accept("vn")) {
      mesh.normals.push_back(read_numbers<3>(text));
    } else if (text.accept("f") || text.accept("fo")) {
      read_face(text, mesh, material);
    } else if (text.accept("o")) {
      begin_object(rest_of_line(text), mesh);
    } else if (text.accept("usemtl")) {
      const auto next = static_cast<int>(mesh.materials.size());
      const auto [named, is_new] = number_of_material.try_emplace(rest_of_line(text), next);
      if (is_new) mesh.materials.push_back(named->first);
      material = named->second;
    } else if (text.accept("mtllib")) {
      obj.libraries.push_back(rest_of_line(text));
    } else if (text.peek() == '#') {
      text.skip_line();
      continue;
    }
    text.skip_continued_line();
  }
  if (!mesh.colours.empty()) mesh.colours.resize(mesh.places.size() / 3, {1, 1, 1, 1});
  for (DressedCorner& corner : mesh.corners) {
    if (corner.place < 0 || idx(corner.place) >= mesh.places.size() / 3) {
      file.fail("a vertex index that is not there",
                "one of the " + std::to_string(mesh.places.size() / 3) + " vertices",
                "export the file again");
    }
    if (corner.texture >= static_cast<std::int64_t>(mesh.textures.size())) corner.texture = -1;
    if (corner.normal >= static_cast<std::int64_t>(mesh.normals.size())) corner.normal = -1;
    if (!mesh.colours.empty()) corner.colour = corner.place;
  }
  finish_objects(mesh);
  return obj;
}

}  // namespace curveskel
