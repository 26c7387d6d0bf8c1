// PLY: the elements "vertex" (x, y, z, perhaps radius and life) and "edge" (vertex1, vertex2).
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "skeleton/io/raw_graph.hpp"
#include "surface/read/ply_header.hpp"
#include "surface/read/ply_values.hpp"

namespace curveskel {
namespace {

enum class EdgeRole { ignored, x, y, z, radius, life, from, to };

EdgeRole edge_role(const PlyElement& element, const PlyProperty& property) {
  if (property.is_list) return EdgeRole::ignored;
  if (element.name == "vertex") {
    if (property.name == "x") return EdgeRole::x;
    if (property.name == "y") return EdgeRole::y;
    if (property.name == "z") return EdgeRole::z;
    if (property.name == "radius") return EdgeRole::radius;
    if (property.name == "life") return EdgeRole::life;
  }
  if (element.name == "edge") {
    if (property.name == "vertex1") return EdgeRole::from;
    if (property.name == "vertex2") return EdgeRole::to;
  }
  return EdgeRole::ignored;
}

const PlyElement& element_named(const FileBytes& file, const PlyHeader& header,
                                std::string_view name) {
  const auto named = [&](const PlyElement& element) { return element.name == name; };
  const auto found = std::find_if(header.elements.begin(), header.elements.end(), named);
  const auto count = std::count_if(header.elements.begin(), header.elements.end(), named);
  if (count != 1) {
    file.fail(std::to_string(count) + " elements \"" + std::string(name) + "\"",
              "one each of the elements \"vertex\" and \"edge\" of a skeleton",
              "if this is a surface give the skeleton's file, else export it again");
  }
  return *found;
}

void need_roles(const FileBytes& file, const PlyElement& element,
                std::initializer_list<EdgeRole> needed, std::string_view names) {
  for (const EdgeRole role : needed) {
    const bool there =
        std::any_of(element.properties.begin(), element.properties.end(),
                    [&](const auto& property) { return edge_role(element, property) == role; });
    if (!there) {
      file.fail("an element \"" + element.name + "\" without one of " + std::string(names),
                "all of them", "export the file again");
    }
  }
}

template <typename Values>
void read_row(Values& values, PlyPlace& place, std::int64_t vertices, RawGraph& graph) {
  Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
  double radius = RawGraph::unknown;
  double life = RawGraph::unknown;
  std::pair<int, int> edge;
  for (const PlyProperty& property : place.element->properties) {
    place.property = &property;
    switch (edge_role(*place.element, property)) {
      case EdgeRole::x:
        point.x() = coordinate(values, place);
        break;
      case EdgeRole::y:
        point.y() = coordinate(values, place);
        break;
      case EdgeRole::z:
        point.z() = coordinate(values, place);
        break;
      case EdgeRole::radius:
        radius = coordinate(values, place);
        break;
      case EdgeRole::life:
        life = coordinate(values, place);
        break;
      case EdgeRole::from:
        edge.first = vertex_index(values, place, vertices, 0);
        break;
      case EdgeRole::to:
        edge.second = vertex_index(values, place, vertices, 0);
        break;
      case EdgeRole::ignored:
        values.skip(property.type, property.is_list ? list_length(values, place) : 1, place);
        break;
    }
  }
  if (place.element->name == "vertex") graph.add(point, radius, life);
  if (place.element->name == "edge") graph.edges.push_back(edge);
}

}  // namespace

RawGraph read_ply_edges(const FileBytes& file) {
  const PlyHeader header = read_ply_header(file);
  const PlyElement& edge = element_named(file, header, "edge");
  const PlyElement& vertex = element_named(file, header, "vertex");
  need_roles(file, vertex, {EdgeRole::x, EdgeRole::y, EdgeRole::z}, "x, y, z");
  need_roles(file, edge, {EdgeRole::from, EdgeRole::to}, "vertex1, vertex2");
  RawGraph graph;
  with_ply_values(file, header, [&](auto values) {
    for (const PlyElement& element : header.elements) {
      if (element.properties.empty()) continue;
      PlyPlace place{&element, nullptr, 0};
      for (; place.row < element.count; ++place.row) read_row(values, place, vertex.count, graph);
    }
  });
  // With faces it is somebody's surface that has edges, and only these are the skeleton.
  const bool faces =
      std::any_of(header.elements.begin(), header.elements.end(),
                  [](const PlyElement& e) { return e.name == "face" && e.count > 0; });
  for (int node = 0; !faces && node < static_cast<int>(graph.points.size()); ++node) {
    graph.alone.push_back(node);
  }
  return graph;
}

}  // namespace curveskel
