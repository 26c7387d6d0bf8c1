// The two XML formats: VTK's PolyData and GraphML.
#include <fast_float/fast_float.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "skeleton/io/raw_graph.hpp"
#include "surface/read/vtk_array.hpp"
#include "surface/read/xml.hpp"

namespace curveskel {
namespace {

const XmlElement& child_of(const FileBytes& file, const XmlElement& element,
                           std::string_view name) {
  const XmlElement* child = element.child(name);
  if (child == nullptr) {
    fail_at(file, element.position, "<" + element.name + "> without <" + std::string(name) + ">",
            "one");
  }
  return *child;
}

const XmlElement* array_named(const XmlElement* parent, std::string_view name) {
  if (parent == nullptr) return nullptr;
  for (const XmlElement* array : parent->all("DataArray")) {
    if (array->attribute("Name") == name) return array;
  }
  return nullptr;
}

/// Radii go by several names; VMTK's is the longest.
const XmlElement* radius_array(const XmlElement& piece) {
  for (const std::string_view name :
       {"radius", "Radius", "radii", "Radii", "MaximumInscribedSphereRadius"}) {
    const XmlElement* array = array_named(piece.child("PointData"), name);
    if (array != nullptr) return array;
  }
  return nullptr;
}

/// One number of each point, `unknown` where there is no such array.
std::vector<double> numbers_of_points(const FileBytes& file, const XmlElement& vtk_file,
                                      const XmlElement* array, std::size_t points) {
  if (array == nullptr) return std::vector<double>(points, RawGraph::unknown);
  std::vector<double> numbers = vtk_values(file, vtk_file, *array);
  if (numbers.size() == points) return numbers;
  fail_at(file, array->position,
          std::to_string(numbers.size()) + " numbers in " + in_quotes(array->attribute("Name")) +
              " for " + std::to_string(points) + " points",
          "one per point");
}

void add_points(const FileBytes& file, const XmlElement& vtk_file, const XmlElement& piece,
                RawGraph& graph) {
  const XmlElement& array = child_of(file, child_of(file, piece, "Points"), "DataArray");
  const std::vector<double> points = vtk_values(file, vtk_file, array);
  if (points.size() % 3 != 0) {
    fail_at(file, array.position, std::to_string(points.size()) + " coordinates",
            "three per point");
  }
  const std::size_t count = points.size() / 3;
  const std::vector<double> radii = numbers_of_points(file, vtk_file, radius_array(piece), count);
  const std::vector<double> lives =
      numbers_of_points(file, vtk_file, array_named(piece.child("PointData"), "life"), count);
  for (std::size_t p = 0; p < count; ++p) {
    const Eigen::RowVector3d point(points[3 * p], points[3 * p + 1], points[3 * p + 2]);
    if (!point.allFinite()) {
      fail_at(file, array.position,
              "a coordinate of point " + std::to_string(p) + " that is " +
                  (std::isnan(point.sum()) ? "NaN" : "infinite"),
              "finite numbers");
    }
    graph.add(point, radii[p], lives[p]);
  }
}

/// The chains of <Lines> or the single points of <Verts>; `base` is the piece's first point.
void add_cells(const FileBytes& file, const XmlElement& vtk_file, const XmlElement* cells, int base,
               RawGraph& graph) {
  const XmlElement* connectivity = array_named(cells, "connectivity");
  const XmlElement* offsets = array_named(cells, "offsets");
  if (connectivity == nullptr || offsets == nullptr) return;
  const std::vector<double> points = vtk_values(file, vtk_file, *connectivity);
  const double most = static_cast<double>(graph.points.size()) - base;
  std::size_t begin = 0;
  for (const double offset : vtk_values(file, vtk_file, *offsets)) {
    if (!(offset >= static_cast<double>(begin) && offset <= static_cast<double>(points.size()))) {
      fail_at(file, offsets->position, "an offset that runs backwards or past the connectivity",
              "ascending offsets up to " + std::to_string(points.size()));
    }
    std::vector<int> chain;
    for (; begin < static_cast<std::size_t>(offset); ++begin) {
      if (!(points[begin] >= 0 && points[begin] < most)) {
        fail_at(file, connectivity->position, "a point index that does not exist",
                "indices from 0 to " + std::to_string(static_cast<long>(most) - 1));
      }
      chain.push_back(base + static_cast<int>(points[begin]));
    }
    if (cells->name == "Lines") {
      graph.add_chain(chain);
    } else {
      graph.alone.insert(graph.alone.end(), chain.begin(), chain.end());
    }
  }
}

/// The number of a node for which a GraphML key stands.
struct GraphmlKeys {
  std::unordered_map<std::string, std::size_t> column;  ///< key id -> x, y, z, radius, life

  explicit GraphmlKeys(const XmlElement& root) {
    constexpr std::array<std::string_view, 5> names{"x", "y", "z", "radius", "life"};
    for (const XmlElement* key : root.all("key")) {
      for (std::size_t k = 0; k < names.size(); ++k) {
        if (key->attribute("attr.name") == names[k] && key->attribute("for", "node") != "edge") {
          column.emplace(key->attribute("id"), k);
        }
      }
    }
  }
};

double number_in(const FileBytes& file, const XmlElement& data) {
  constexpr std::string_view blanks = " \t\r\n";
  std::string_view text = data.text;
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  text = text.substr(0, text.find_last_not_of(blanks) + 1);
  double value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    fail_at(file, data.position, in_quotes(text), "a finite number");
  }
  return value;
}

void add_graphml_node(const FileBytes& file, const XmlElement& node, const GraphmlKeys& keys,
                      RawGraph& graph) {
  std::array<double, 5> values;
  values.fill(RawGraph::unknown);
  for (const XmlElement* data : node.all("data")) {
    const auto column = keys.column.find(std::string(data->attribute("key")));
    if (column != keys.column.end()) values[column->second] = number_in(file, *data);
  }
  const Eigen::RowVector3d point(values[0], values[1], values[2]);
  if (point.array().isNaN().any()) {
    fail_at(file, node.position, "node " + in_quotes(node.attribute("id")) + " without x, y or z",
            "all three");
  }
  graph.add(point, values[3], values[4]);
}

}  // namespace

RawGraph read_vtp(const FileBytes& file) {
  const XmlElement root = parse_xml(file);
  if (root.name != "VTKFile" || root.attribute("type") != "PolyData") {
    fail_at(file, root.position,
            "<" + root.name + " type=" + in_quotes(root.attribute("type")) + ">",
            "<VTKFile type=\"PolyData\">");
  }
  RawGraph graph;
  for (const XmlElement* piece : child_of(file, root, "PolyData").all("Piece")) {
    const int base = static_cast<int>(graph.points.size());
    if (piece->attribute("NumberOfPoints") == "0") continue;
    add_points(file, root, *piece, graph);
    add_cells(file, root, piece->child("Lines"), base, graph);
    add_cells(file, root, piece->child("Verts"), base, graph);
  }
  return graph;
}

RawGraph read_graphml(const FileBytes& file) {
  const XmlElement root = parse_xml(file);
  if (root.name != "graphml") fail_at(file, root.position, "<" + root.name + ">", "<graphml>");
  const GraphmlKeys keys(root);
  const XmlElement& body = child_of(file, root, "graph");
  RawGraph graph;
  std::unordered_map<std::string, int> node_of;
  for (const XmlElement* node : body.all("node")) {
    if (!node_of.emplace(node->attribute("id"), static_cast<int>(graph.points.size())).second) {
      fail_at(file, node->position, "a second node " + in_quotes(node->attribute("id")),
              "different ids");
    }
    add_graphml_node(file, *node, keys, graph);
  }
  for (const XmlElement* edge : body.all("edge")) {
    const auto from = node_of.find(std::string(edge->attribute("source")));
    const auto to = node_of.find(std::string(edge->attribute("target")));
    if (from == node_of.end() || to == node_of.end()) {
      fail_at(file, edge->position,
              "an edge from " + in_quotes(edge->attribute("source")) + " to " +
                  in_quotes(edge->attribute("target")),
              "the ids of two nodes");
    }
    graph.edges.emplace_back(from->second, to->second);
  }
  return graph;
}

}  // namespace curveskel
