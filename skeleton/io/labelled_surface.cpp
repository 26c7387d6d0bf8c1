#include <curveskel/labelled_surface.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include "base/decimal.hpp"
#include "base/one_line.hpp"
#include "base/option_ranges.hpp"
#include "base/utf8.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/io/xml_lines.hpp"
#include "surface/repair/sound_soup.hpp"

namespace curveskel {
namespace {

struct Labelled {
  const PolygonSoup& soup;
  const Eigen::VectorXi& of_vertex;
  const Eigen::VectorXi& of_polygon;
  std::string_view provenance;

  [[nodiscard]] std::size_t vertices() const { return idx(soup.positions.rows()); }
  [[nodiscard]] std::size_t polygons() const { return soup.offsets.size() - 1; }
  [[nodiscard]] std::int64_t corners(std::size_t polygon) const {
    return soup.offsets[polygon + 1] - soup.offsets[polygon];
  }
};

template <typename Value>
void append_value(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_colour(std::string& bytes, int branch) {
  for (const std::uint8_t part : branch_colour(branch)) append_value(bytes, part);
}

std::string ply_of(const Labelled& labelled) {
  const PolygonSoup& soup = labelled.soup;
  std::int64_t most_corners = 0;
  for (std::size_t p = 0; p < labelled.polygons(); ++p) {
    most_corners = std::max(most_corners, labelled.corners(p));
  }
  const bool small = most_corners < 256;
  const std::string colour =
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int branch\n";
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  if (!labelled.provenance.empty()) bytes += "comment " + in_one_line(labelled.provenance) + "\n";
  bytes += "element vertex " + std::to_string(labelled.vertices()) +
           "\nproperty double x\nproperty double y\nproperty double z\n" + colour;
  bytes += "element face " + std::to_string(labelled.polygons()) + "\nproperty list " +
           (small ? "uchar" : "int") + " int vertex_indices\n" + colour + "end_header\n";
  for (Eigen::Index vertex = 0; vertex < soup.positions.rows(); ++vertex) {
    for (const double x : soup.positions.row(vertex)) append_value(bytes, x);
    append_colour(bytes, labelled.of_vertex[vertex]);
    append_value(bytes, static_cast<std::int32_t>(labelled.of_vertex[vertex]));
  }
  for (std::size_t p = 0; p < labelled.polygons(); ++p) {
    const auto count = labelled.corners(p);
    if (small) {
      append_value(bytes, static_cast<std::uint8_t>(count));
    } else {
      append_value(bytes, static_cast<std::int32_t>(count));
    }
    for (auto k = soup.offsets[p]; k < soup.offsets[p + 1]; ++k) {
      append_value(bytes, soup.corners[idx(k)]);
    }
    const int label = labelled.of_polygon[static_cast<Eigen::Index>(p)];
    append_colour(bytes, label);
    append_value(bytes, static_cast<std::int32_t>(label));
  }
  return bytes;
}

void append_labels(pugi::xml_node piece, const char* element, const Eigen::VectorXi& labels) {
  pugi::xml_node data = XmlLines::open(piece, element);
  data.append_attribute("Scalars") = "branch";
  const auto rows = idx(labels.size());
  const auto label = [&](std::size_t row) { return labels[static_cast<Eigen::Index>(row)]; };
  append_array(data, "Int32", "branch", 1, rows,
               [&](std::string& text, std::size_t row) { append_decimal(text, label(row)); });
  append_array(data, "UInt8", "colour", 3, rows, [&](std::string& text, std::size_t row) {
    const auto [red, green, blue] = branch_colour(label(row));
    append_decimals(text, std::array<int, 3>{red, green, blue}, ' ');
  });
  XmlLines::end_line(piece);
}

std::string vtp_of(const Labelled& labelled) {
  const PolygonSoup& soup = labelled.soup;
  XmlLines xml{std::string(labelled.provenance)};
  const PolyDataElements elements =
      open_poly_data(xml, {labelled.vertices(), 0, 0, labelled.polygons()});
  pugi::xml_node piece = elements.piece;
  append_labels(piece, "PointData", labelled.of_vertex);
  append_labels(piece, "CellData", labelled.of_polygon);
  pugi::xml_node points = XmlLines::open(piece, "Points");
  append_array(points, "Float64", "points", 3, labelled.vertices(),
               [&](std::string& text, std::size_t row) {
                 append_decimals(text, soup.positions.row(static_cast<Eigen::Index>(row)), ' ');
               });
  XmlLines::end_line(piece);
  pugi::xml_node cells = XmlLines::open(piece, "Polys");
  append_array(cells, "Int64", "connectivity", 1, labelled.polygons(),
               [&](std::string& text, std::size_t p) {
                 for (auto k = soup.offsets[p]; k < soup.offsets[p + 1]; ++k) {
                   if (k > soup.offsets[p]) text += ' ';
                   append_decimal(text, soup.corners[idx(k)]);
                 }
               });
  append_array(
      cells, "Int64", "offsets", 1, labelled.polygons(),
      [&](std::string& text, std::size_t p) { append_decimal(text, soup.offsets[p + 1]); });
  XmlLines::end_line(piece);
  close_poly_data(xml, elements);
  return xml.text();
}

/// One buffer with views and accessors into it.
class GltfBuffer {
 public:
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors = nlohmann::ordered_json::array();
  std::string bytes;

  /// Everything since the last call becomes an accessor.
  nlohmann::ordered_json& end_array(int component, const char* type, std::size_t count,
                                    int target) {
    views.push_back({{"buffer", 0},
                     {"byteOffset", begun_},
                     {"byteLength", bytes.size() - begun_},
                     {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    begun_ = bytes.size();
    return accessors.back();
  }

 private:
  std::size_t begun_ = 0;
};

constexpr int component_uint8 = 5121;
constexpr int component_uint32 = 5125;
constexpr int component_float = 5126;
constexpr int for_vertices = 34962;
constexpr int for_indices = 34963;

void append_vertices(GltfBuffer& buffer, const Labelled& labelled) {
  const Eigen::MatrixX3f places = labelled.soup.positions.cast<float>();
  for (Eigen::Index row = 0; row < places.rows(); ++row) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) append_value(buffer.bytes, places(row, axis));
  }
  const Eigen::RowVector3f least = places.colwise().minCoeff();
  const Eigen::RowVector3f most = places.colwise().maxCoeff();
  auto& accessor = buffer.end_array(component_float, "VEC3", labelled.vertices(), for_vertices);
  accessor["min"] = {least[0], least[1], least[2]};
  accessor["max"] = {most[0], most[1], most[2]};
  for (const int label : labelled.of_vertex) {
    append_colour(buffer.bytes, label);
    append_value(buffer.bytes, std::uint8_t{255});
  }
  buffer.end_array(component_uint8, "VEC4", labelled.vertices(), for_vertices)["normalized"] = true;
  for (const int label : labelled.of_vertex) append_value(buffer.bytes, static_cast<float>(label));
  buffer.end_array(component_float, "SCALAR", labelled.vertices(), for_vertices);
}

void append_chunk(std::string& file, std::string content, std::uint32_t kind, char padding) {
  while (content.size() % 4 != 0) content += padding;
  append_value(file, static_cast<std::uint32_t>(content.size()));
  append_value(file, kind);
  file += content;
}

std::string glb_of(const Labelled& labelled) {
  GltfBuffer buffer;
  append_vertices(buffer, labelled);
  const Triangles triangles = triangulate(labelled.soup);
  for (const std::int32_t vertex : triangles.reshaped<Eigen::RowMajor>()) {
    append_value(buffer.bytes, static_cast<std::uint32_t>(vertex));
  }
  buffer.end_array(component_uint32, "SCALAR", idx(triangles.size()), for_indices);
  const nlohmann::ordered_json primitive = {
      {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}, {"_BRANCH", 2}}}, {"indices", 3}};
  nlohmann::ordered_json document;
  document["asset"] = {{"version", "2.0"},
                       {"generator", as_utf8(std::string(labelled.provenance))}};
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", {0}}}};
  document["nodes"] = {{{"mesh", 0}, {"name", "branches"}}};
  document["meshes"] = {{{"primitives", nlohmann::ordered_json::array({primitive})}}};
  document["buffers"] = {{{"byteLength", buffer.bytes.size()}}};
  document["bufferViews"] = buffer.views;
  document["accessors"] = buffer.accessors;

  std::string chunks;
  append_chunk(chunks, document.dump(), 0x4E4F534A, ' ');
  append_chunk(chunks, buffer.bytes, 0x004E4942, '\0');
  std::string file = "glTF";
  append_value(file, std::uint32_t{2});
  append_value(file, static_cast<std::uint32_t>(chunks.size() + 12));
  return file + chunks;
}

}  // namespace

std::array<std::uint8_t, 3> branch_colour(int branch) {
  constexpr std::uint8_t grey = 160;
  if (branch < 0) return {grey, grey, grey};
  constexpr double golden = 2.39996323;  // radians: no two of the first few are near each other
  constexpr double first_hue = 0.9;
  constexpr double chroma = 0.13;
  const double hue = std::fmod(first_hue + golden * (branch % 4096), 2 * std::numbers::pi);
  const double lightness = branch % 2 == 0 ? 0.72 : 0.64;
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const auto encode = [](double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    const double value =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(value * 255));
  };
  return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

BranchLabels labels_of_input(const PolygonSoup& soup, const RepairedSurface& repaired,
                             const CurveSkeleton& skeleton) {
  require_below(repaired.vertex_of_input, repaired.surface.positions.rows(), "labels_of_input");
  const Eigen::VectorXi of_surface =
      branch_territories(repaired.surface, skeleton).branch_of_vertex;
  BranchLabels labels;
  labels.of_vertex = repaired.vertex_of_input;
  for (int& label : labels.of_vertex) label = label < 0 ? -1 : of_surface[label];
  labels.of_polygon = majority_labels(labels.of_vertex, soup.corners, soup.offsets);
  return labels;
}

std::string format_labelled_surface(const PolygonSoup& soup, const BranchLabels& labels,
                                    LabelledFormat format, std::string_view provenance) {
  OptionCheck("format_labelled_surface").choice("format", format, labelled_formats);
  const auto polygons =
      static_cast<Eigen::Index>(std::max(soup.offsets.size(), std::size_t{1}) - 1);
  require_sound(soup);
  if (labels.of_vertex.size() != soup.positions.rows() || labels.of_polygon.size() != polygons) {
    throw Error(Fault::input, "format_labelled_surface: found labels of " +
                                  std::to_string(labels.of_vertex.size()) + " vertices and " +
                                  std::to_string(labels.of_polygon.size()) +
                                  " polygons, needed one for each of " +
                                  std::to_string(soup.positions.rows()) + " and of " +
                                  std::to_string(polygons));
  }
  const Labelled labelled{soup, labels.of_vertex, labels.of_polygon, provenance};
  switch (format) {
    case LabelledFormat::ply:
      return ply_of(labelled);
    case LabelledFormat::vtp:
      return vtp_of(labelled);
    case LabelledFormat::glb:
      return glb_of(labelled);
  }
  return {};
}

}  // namespace curveskel
