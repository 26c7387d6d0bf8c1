// The two XML formats: VTK's PolyData and GraphML.
#include <algorithm>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/levels.hpp>
#include "base/decimal.hpp"
#include "skeleton/io/skeleton_formats.hpp"
#include "skeleton/io/xml_lines.hpp"

namespace curveskel {
namespace {

void append_cells(pugi::xml_node piece, const char* name, const std::vector<Branch>& cells) {
  pugi::xml_node element = XmlLines::open(piece, name);
  append_array(
      element, "Int64", "connectivity", 1, cells.size(),
      [&](std::string& text, std::size_t cell) { append_decimals(text, cells[cell].nodes, ' '); });
  std::size_t offset = 0;
  append_array(element, "Int64", "offsets", 1, cells.size(),
               [&](std::string& text, std::size_t cell) {
                 offset += cells[cell].nodes.size();
                 append_decimal(text, offset);
               });
  XmlLines::end_line(piece);
}

/// Radii and lives of the nodes, as far as there are any.
void append_point_data(pugi::xml_node piece, const CurveSkeleton& skeleton) {
  const bool has_radii = skeleton.radii.size() > 0;
  if (!has_radii && !has_lives(skeleton)) return;
  pugi::xml_node data = XmlLines::open(piece, "PointData");
  const auto append = [&](const char* name, const Eigen::VectorXd& numbers) {
    append_array(data, "Float64", name, 1, idx(numbers.size()),
                 [&](std::string& text, std::size_t node) {
                   append_decimal(text, numbers(static_cast<Eigen::Index>(node)));
                 });
  };
  if (has_radii) {
    data.append_attribute("Scalars") = "radius";
    append("radius", skeleton.radii);
  }
  if (has_lives(skeleton)) append("life", skeleton.lives);
  XmlLines::end_line(piece);
}

/// Of the points alone and then of the branches.
void append_levels(pugi::xml_node piece, const CurveSkeleton& skeleton, std::size_t points) {
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  pugi::xml_node data = XmlLines::open(piece, "CellData");
  const auto append = [&](const char* name, double of_points, const auto& value) {
    append_array(data, "Float64", name, 1, points + levels.size(),
                 [&](std::string& text, std::size_t cell) {
                   append_decimal(text, cell < points ? of_points : value(levels[cell - points]));
                 });
  };
  append("life", lives_for_ever, [](const BranchLevel& level) { return level.life; });
  append("parent", -1, [](const BranchLevel& level) { return double(level.parent); });
  append("merge", -1, [](const BranchLevel& level) { return level.merge; });
  XmlLines::end_line(piece);
}

void append_keys(pugi::xml_node file, bool has_lives) {
  struct Key {
    const char* id;
    const char* name;
    const char* element;
    const char* type;
  };
  const auto append = [&](const std::vector<Key>& keys) {
    for (const Key& one : keys) {
      pugi::xml_node key = file.append_child("key");
      key.append_attribute("id") = one.id;
      key.append_attribute("for") = one.element;
      key.append_attribute("attr.name") = one.name;
      key.append_attribute("attr.type") = one.type;
      XmlLines::end_line(file);
    }
  };
  append({{"x", "x", "node", "double"},
          {"y", "y", "node", "double"},
          {"z", "z", "node", "double"},
          {"r", "radius", "node", "double"},
          {"l", "length", "edge", "double"}});
  if (!has_lives) return;
  append({{"t", "life", "node", "double"},
          {"life", "life", "edge", "double"},
          {"branch", "branch", "edge", "int"},
          {"parent", "parent", "edge", "int"},
          {"merge", "merge", "edge", "double"}});
}

void append_data(pugi::xml_node element, const char* key, double value) {
  std::string text;
  append_decimal(text, value);
  pugi::xml_node data = element.append_child("data");
  data.append_attribute("key") = key;
  data.text().set(text.c_str());
}

}  // namespace

std::string vtp_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  const std::vector<Branch> lines = branches(skeleton);
  std::vector<Branch> points;
  for (const int node : isolated_nodes(skeleton)) points.push_back(Branch{{node}});
  const auto nodes = static_cast<std::size_t>(skeleton.nodes.rows());

  XmlLines xml(context.provenance);
  const PolyDataElements elements = open_poly_data(xml, {nodes, points.size(), lines.size(), 0});
  pugi::xml_node piece = elements.piece;
  append_point_data(piece, skeleton);
  if (has_lives(skeleton)) append_levels(piece, skeleton, points.size());
  append_array(XmlLines::open(piece, "Points"), "Float64", "points", 3, nodes,
               [&](std::string& text, std::size_t node) {
                 append_decimals(text, skeleton.nodes.row(static_cast<Eigen::Index>(node)), ' ');
               });
  XmlLines::end_line(piece);
  append_cells(piece, "Verts", points);
  append_cells(piece, "Lines", lines);
  close_poly_data(xml, elements);
  return xml.text();
}

std::string graphml_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  XmlLines xml(context.provenance);
  pugi::xml_node file = XmlLines::open(xml.document, "graphml");
  file.append_attribute("xmlns") = "http://graphml.graphdrawing.org/xmlns";
  file.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
  file.append_attribute("xsi:schemaLocation") =
      "http://graphml.graphdrawing.org/xmlns "
      "http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd";
  append_keys(file, has_lives(skeleton));
  pugi::xml_node graph = XmlLines::open(file, "graph");
  graph.append_attribute("id") = "skeleton";
  graph.append_attribute("edgedefault") = "undirected";
  const auto id_of = [](Eigen::Index node) { return "n" + std::to_string(node); };
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    pugi::xml_node element = graph.append_child("node");
    element.append_attribute("id") = id_of(node).c_str();
    append_data(element, "x", skeleton.nodes(node, 0));
    append_data(element, "y", skeleton.nodes(node, 1));
    append_data(element, "z", skeleton.nodes(node, 2));
    if (skeleton.radii.size() > 0) append_data(element, "r", skeleton.radii(node));
    if (has_lives(skeleton)) append_data(element, "t", skeleton.lives(node));
    XmlLines::end_line(graph);
  }
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  const std::vector<int> branch_of_edge = branch_of_edges(skeleton);
  for (Eigen::Index row = 0; row < skeleton.edges.rows(); ++row) {
    const auto edge = skeleton.edges.row(row);
    pugi::xml_node element = graph.append_child("edge");
    element.append_attribute("source") = id_of(edge(0)).c_str();
    element.append_attribute("target") = id_of(edge(1)).c_str();
    append_data(element, "l", (skeleton.nodes.row(edge(0)) - skeleton.nodes.row(edge(1))).norm());
    if (has_lives(skeleton)) {
      const BranchLevel& level = levels[idx(branch_of_edge[idx(row)])];
      append_data(element, "life", level.life);
      append_data(element, "branch", branch_of_edge[idx(row)]);
      if (level.parent >= 0) append_data(element, "parent", level.parent);
      if (level.merge >= 0) append_data(element, "merge", level.merge);
    }
    XmlLines::end_line(graph);
  }
  XmlLines::end_line(file);
  XmlLines::end_line(xml.document);
  return xml.text();
}

}  // namespace curveskel
