// JSON: this program's own, and node-link graphs (networkx, d3) whose nodes have x, y, z.
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json_depth.hpp"
#include "skeleton/io/raw_graph.hpp"

namespace curveskel {
namespace {

using nlohmann::json;

/// Finds its way through one file.
class JsonGraph {
 public:
  explicit JsonGraph(const FileBytes& file) : file_(file) {
    const int depth = json_depth(file.content);
    if (depth > deepest_json) {  // dump(), for messages, recurses
      fail("arrays and objects nested " + std::to_string(depth) + " deep",
           "at most " + std::to_string(deepest_json));
    }
    try {
      root_ = json::parse(file.content);
    } catch (const json::exception& error) {
      // "[json...] parse error at line 3, column 7: ...", or of a number that no double holds
      // "[json...] number overflow parsing ..."
      const std::string_view what = error.what();
      const std::size_t words = std::min(what.find("at line"), what.find("number overflow"));
      file.fail(what.substr(std::min(words, what.size())), "JSON",
                "correct it or export the file again");
    }
  }

  RawGraph read() {
    if (root_.is_object() && root_.contains("joints") && !root_.contains("nodes")) {
      file_.fail("a rig", "a skeleton, whose JSON has \"nodes\" and \"edges\"",
                 "give the skeleton; curveskel rig --joints takes rigs");
    }
    if (root_.is_object() && root_.contains("asset") && root_.contains("meshes")) {
      file_.fail("a surface file (gltf)", "a skeleton, whose JSON has \"nodes\" and \"edges\"",
                 "give the skeleton of that surface");
    }
    const json& nodes = list("nodes");
    for (std::size_t n = 0; n < nodes.size(); ++n) add_node(nodes[n], n);
    add_radii();
    const json& edges =
        root_.contains("links") && !root_.contains("edges") ? list("links") : list("edges");
    for (std::size_t e = 0; e < edges.size(); ++e) add_edge(edges[e], e);
    add_vertex_map();
    add_lives();
    add_root();
    return std::move(graph_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, std::string_view needed) const {
    file_.fail(found, needed, "correct it or export the file again");
  }

  const json& list(const char* name) const {
    if (!root_.is_object() || !root_.contains(name) || !root_[name].is_array()) {
      fail("no array \"" + std::string(name) + "\"", "an object with \"nodes\" and \"edges\"");
    }
    return root_[name];
  }

  double number(const json& value, const std::string& where) const {
    const double found = value.is_number() ? value.get<double>() : RawGraph::unknown;
    if (!std::isfinite(found)) fail(value.dump().substr(0, 40) + " " + where, "a finite number");
    return found;
  }

  void add_node(const json& node, std::size_t row) {
    const std::string where = "in node " + std::to_string(row);
    if (node.is_array() && node.size() == 3) {
      graph_.add({number(node[0], where), number(node[1], where), number(node[2], where)});
    } else if (node.is_object() && node.contains("x") && node.contains("y") && node.contains("z")) {
      graph_.add({number(node["x"], where), number(node["y"], where), number(node["z"], where)},
                 node.contains("radius") ? number(node["radius"], where) : RawGraph::unknown,
                 node.contains("life") ? number(node["life"], where) : RawGraph::unknown);
      ids_[node.contains("id") ? node["id"].dump() : std::to_string(row)] = static_cast<int>(row);
    } else {
      fail(node.dump().substr(0, 40) + " " + where, "[x, y, z] or an object with x, y and z");
    }
  }

  /// One number per node, or none where the file has none.
  std::vector<double> of_nodes(const char* name, const std::string& one) const {
    std::vector<double> numbers;
    if (!root_.contains(name) || root_[name].empty()) return numbers;
    const json& values = list(name);
    if (values.size() != graph_.points.size()) {
      fail(std::to_string(values.size()) + " " + name,
           "one per node (" + std::to_string(graph_.points.size()) + ")");
    }
    numbers.reserve(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) {
      numbers.push_back(number(values[n], "in " + one + " " + std::to_string(n)));
    }
    return numbers;
  }

  void add_radii() {
    std::vector<double> radii = of_nodes("radii", "radius");
    if (!radii.empty()) graph_.radii = std::move(radii);
  }

  void add_lives() {
    std::vector<double> lives = of_nodes("lives", "life");
    if (!lives.empty()) graph_.lives = std::move(lives);
  }

  int node(const json& value, const std::string& where) const {
    const auto named = ids_.find(value.dump());
    if (named != ids_.end()) return named->second;
    const auto nodes = static_cast<std::int64_t>(graph_.points.size());
    const std::int64_t index = value.is_number_integer() ? value.get<std::int64_t>() : -1;
    if (!ids_.empty() || index < 0 || index >= nodes) {
      fail(value.dump().substr(0, 40) + " " + where,
           ids_.empty() ? "an index from 0 to " + std::to_string(nodes - 1) : "the id of a node");
    }
    return static_cast<int>(index);
  }

  void add_edge(const json& edge, std::size_t row) {
    const std::string where = "in edge " + std::to_string(row);
    if (edge.is_array() && edge.size() == 2) {
      graph_.edges.emplace_back(node(edge[0], where), node(edge[1], where));
    } else if (edge.is_object() && edge.contains("source") && edge.contains("target")) {
      graph_.edges.emplace_back(node(edge["source"], where), node(edge["target"], where));
    } else {
      fail(edge.dump().substr(0, 40) + " " + where, "[i, j] or an object with source and target");
    }
  }

  void add_vertex_map() {
    if (!root_.contains("node_of_vertex")) return;
    const json& map = list("node_of_vertex");
    graph_.node_of_vertex.resize(static_cast<Eigen::Index>(map.size()));
    for (std::size_t v = 0; v < map.size(); ++v) {
      const std::string where = "in node_of_vertex " + std::to_string(v);
      graph_.node_of_vertex(static_cast<Eigen::Index>(v)) = map[v] == -1 ? -1 : node(map[v], where);
    }
  }

  /// Nothing else depends on it, so a wrong one is none.
  void add_root() {
    if (!root_.contains("root") || !root_["root"].is_number_integer()) return;
    const auto root = root_["root"].get<std::int64_t>();
    const auto nodes = static_cast<std::int64_t>(graph_.points.size());
    if (ids_.empty() && root >= 0 && root < nodes) graph_.root = static_cast<int>(root);
  }

  const FileBytes& file_;
  json root_;
  RawGraph graph_;
  std::map<std::string, int> ids_;  ///< as JSON text, so that 1 and "1" differ
};

}  // namespace

RawGraph read_json_graph(const FileBytes& file) { return JsonGraph(file).read(); }

}  // namespace curveskel
