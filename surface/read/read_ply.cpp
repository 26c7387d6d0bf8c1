// Stanford PLY. One walk over rows and properties serves all three encodings: the template argument
// only fetches single values.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "surface/read/formats.hpp"
#include "surface/read/ply_header.hpp"
#include "surface/read/ply_values.hpp"
#include "surface/read/triangle_strip.hpp"

namespace curveskel {
namespace {

enum class FaceRole { ignored, x, y, z, polygon, strip };

FaceRole face_role(const PlyElement& element, const PlyProperty& property) {
  if (element.name == "vertex" && !property.is_list) {
    if (property.name == "x") return FaceRole::x;
    if (property.name == "y") return FaceRole::y;
    if (property.name == "z") return FaceRole::z;
  }
  const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
  if (indices && property.is_list && element.name == "face") return FaceRole::polygon;
  if (indices && property.is_list && element.name == "tristrips") return FaceRole::strip;
  return FaceRole::ignored;
}

template <typename Values>
void read_polygon(Values& values, const PlyPlace& place, PolygonSoup& soup) {
  for (std::int64_t left = list_length(values, place); left > 0; --left) {
    soup.corners.push_back(vertex_index(values, place, soup.positions.rows(), 0));
  }
  end_polygon(soup);
}

/// -1 starts a new strip.
template <typename Values>
void read_strip(Values& values, const PlyPlace& place, PolygonSoup& soup) {
  std::vector<std::int32_t> strip;
  for (std::int64_t left = list_length(values, place); left > 0; --left) {
    const std::int32_t vertex = vertex_index(values, place, soup.positions.rows(), -1);
    if (vertex >= 0) {
      strip.push_back(vertex);
      continue;
    }
    append_strip(strip, soup);
    strip.clear();
  }
  append_strip(strip, soup);
}

template <typename Values>
void read_row(Values& values, PlyPlace& place, const std::vector<FaceRole>& roles,
              PolygonSoup& soup) {
  for (std::size_t i = 0; i < roles.size(); ++i) {
    place.property = &place.element->properties[i];
    switch (roles[i]) {
      case FaceRole::x:
      case FaceRole::y:
      case FaceRole::z:
        soup.positions(place.row, static_cast<int>(roles[i]) - static_cast<int>(FaceRole::x)) =
            values.number(place.property->type, place);
        break;
      case FaceRole::polygon:
        read_polygon(values, place, soup);
        break;
      case FaceRole::strip:
        read_strip(values, place, soup);
        break;
      case FaceRole::ignored:
        values.skip(place.property->type, place.property->is_list ? list_length(values, place) : 1,
                    place);
        break;
    }
  }
}

/// Room for triangles, the most common polygons, if the rest of the file can hold as many.
template <typename Values>
void reserve_triangles(const Values& values, const PlyElement& element,
                       const std::vector<FaceRole>& roles, PolygonSoup& soup) {
  const auto polygon = std::find(roles.begin(), roles.end(), FaceRole::polygon);
  if (polygon == roles.end()) return;
  const PlyProperty& property =
      element.properties[static_cast<std::size_t>(polygon - roles.begin())];
  if (!values.may_hold(property.type, 3 * element.count)) return;
  soup.corners.reserve(soup.corners.size() + 3 * static_cast<std::size_t>(element.count));
  soup.offsets.reserve(soup.offsets.size() + static_cast<std::size_t>(element.count));
}

template <typename Values>
void read_elements(Values values, const PlyHeader& header, PolygonSoup& soup,
                   const Monitor& monitor) {
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;
    std::vector<FaceRole> roles;
    for (const auto& property : element.properties) roles.push_back(face_role(element, property));
    reserve_triangles(values, element, roles, soup);
    PlyPlace place{&element, nullptr, 0};
    for (; place.row < element.count; ++place.row) {
      if (place.row % rows_per_report == 0) monitor.report("read", values.fraction());
      read_row(values, place, roles, soup);
    }
  }
}

/// Faces may come before the vertices that they refer to, so the vertices are counted first.
std::int64_t check_vertices(const FileBytes& file, const PlyHeader& header) {
  std::int64_t vertices = 0;
  int elements = 0;
  for (const auto& element : header.elements) {
    if (element.name != "vertex") continue;
    ++elements;
    vertices = element.count;
    for (const std::string_view name : {"x", "y", "z"}) {
      const bool there = std::any_of(
          element.properties.begin(), element.properties.end(),
          [&](const PlyProperty& property) { return property.name == name && !property.is_list; });
      if (!there) {
        file.fail("no property \"" + std::string(name) + "\" in element \"vertex\"",
                  "the properties x, y and z", "export the file again");
      }
    }
  }
  if (elements != 1 || vertices > most_vertices) {
    file.fail(std::to_string(elements) + " elements \"vertex\" with " + std::to_string(vertices) +
                  " rows",
              "one of at most " + std::to_string(most_vertices) + " rows",
              "export the file again, split or decimated if it is that large");
  }
  return vertices;
}

void refuse_edges_alone(const FileBytes& file, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.name != "edge" || element.count == 0) continue;
    file.fail("a skeleton or a drawing of lines: " + std::to_string(element.count) +
                  (element.count == 1 ? " edge" : " edges") + " and no faces",
              "a surface with faces", "give the surface, of which a skeleton can be made");
  }
}

}  // namespace

PolygonSoup read_ply(const FileBytes& file, const Monitor& monitor) {
  const PlyHeader header = read_ply_header(file);
  PolygonSoup soup;
  soup.format = SurfaceFormat::ply;
  soup.offsets.push_back(0);
  soup.positions.resize(check_vertices(file, header), 3);
  with_ply_values(file, header,
                  [&](auto values) { read_elements(std::move(values), header, soup, monitor); });
  if (soup.offsets.size() < 2) refuse_edges_alone(file, header);
  return soup;
}

bool looks_like_ply(const FileBytes& file) {
  return file.content.starts_with("ply\n") || file.content.starts_with("ply\r");
}

}  // namespace curveskel
