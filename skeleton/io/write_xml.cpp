// The two XML formats: VTK's PolyData and GraphML.
#include <string_view>

#include "base/decimal.hpp"
#include "skeleton/io/skeleton_formats.hpp"

namespace curveskel {
namespace {

constexpr std::string_view xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// Inside a comment "--" is not allowed, and neither are control characters.
std::string xml_comment(const std::string& provenance) {
  if (provenance.empty()) return {};
  std::string text = "<!-- ";
  for (const char c : provenance) {
    if (c == '-' && text.back() == '-') text += ' ';
    text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return text + " -->\n";
}

/// A DataArray with one line per call of `append_row`.
template <typename AppendRow>
void append_array(std::string& text, std::string_view attributes, std::size_t rows,
                  const AppendRow& append_row) {
  text.append("<DataArray ").append(attributes).append(" format=\"ascii\">\n");
  for (std::size_t row = 0; row < rows; ++row) {
    append_row(row);
    text += '\n';
  }
  text += "</DataArray>\n";
}

void append_cells(std::string& text, std::string_view element, const std::vector<Branch>& cells) {
  text.append("<").append(element).append(">\n");
  append_array(text, R"(type="Int64" Name="connectivity")", cells.size(),
               [&](std::size_t cell) { append_decimals(text, cells[cell].nodes, ' '); });
  std::size_t offset = 0;
  append_array(text, R"(type="Int64" Name="offsets")", cells.size(), [&](std::size_t cell) {
    offset += cells[cell].nodes.size();
    append_decimal(text, offset);
  });
  text.append("</").append(element).append(">\n");
}

void append_data(std::string& text, char key, double value) {
  text.append("<data key=\"").append(1, key).append("\">");
  append_decimal(text, value);
  text += "</data>";
}

}  // namespace

std::string vtp_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  const std::vector<Branch> lines = branches(skeleton);
  std::vector<Branch> points;
  for (const int node : isolated_nodes(skeleton)) points.push_back(Branch{{node}});
  const auto nodes = static_cast<std::size_t>(skeleton.nodes.rows());

  std::string text(xml_head);
  text += xml_comment(context.provenance);
  text +=
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(nodes) + "\" NumberOfVerts=\"" + std::to_string(points.size()) +
      "\" NumberOfLines=\"" + std::to_string(lines.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  if (skeleton.radii.size() > 0) {
    text += "<PointData Scalars=\"radius\">\n";
    append_array(text, R"(type="Float64" Name="radius")", nodes, [&](std::size_t node) {
      append_decimal(text, skeleton.radii(static_cast<Eigen::Index>(node)));
    });
    text += "</PointData>\n";
  }
  text += "<Points>\n";
  append_array(text, R"(type="Float64" Name="points" NumberOfComponents="3")", nodes,
               [&](std::size_t node) {
                 append_decimals(text, skeleton.nodes.row(static_cast<Eigen::Index>(node)), ' ');
               });
  text += "</Points>\n";
  append_cells(text, "Verts", points);
  append_cells(text, "Lines", lines);
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string graphml_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  std::string text(xml_head);
  text += xml_comment(context.provenance);
  text +=
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\" "
      "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:schemaLocation=\"http://graphml.graphdrawing.org/xmlns "
      "http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd\">\n";
  for (const std::string_view name : {"x", "y", "z", "radius", "length"}) {
    text.append("<key id=\"").append(name.substr(0, 1)).append("\" for=\"");
    text.append(name == "length" ? "edge" : "node");
    text.append("\" attr.name=\"").append(name).append("\" attr.type=\"double\"/>\n");
  }
  text += "<graph id=\"skeleton\" edgedefault=\"undirected\">\n";
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    text += "<node id=\"n" + std::to_string(node) + "\">";
    append_data(text, 'x', skeleton.nodes(node, 0));
    append_data(text, 'y', skeleton.nodes(node, 1));
    append_data(text, 'z', skeleton.nodes(node, 2));
    if (skeleton.radii.size() > 0) append_data(text, 'r', skeleton.radii(node));
    text += "</node>\n";
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    text += "<edge source=\"n" + std::to_string(edge(0)) + "\" target=\"n" +
            std::to_string(edge(1)) + "\">";
    append_data(text, 'l', (skeleton.nodes.row(edge(0)) - skeleton.nodes.row(edge(1))).norm());
    text += "</edge>\n";
  }
  return text + "</graph>\n</graphml>\n";
}

}  // namespace curveskel
