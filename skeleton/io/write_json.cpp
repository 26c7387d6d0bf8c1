#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include "base/decimal.hpp"
#include "skeleton/io/skeleton_formats.hpp"

namespace curveskel {
namespace {

/// `"name": [` rows `]`, each row on a line of its own as the array [a, b, c].
template <typename Rows>
void append_rows(std::string& text, const char* name, const Rows& rows) {
  text.append(",\n\"").append(name).append("\": [");
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    text += row == 0 ? "\n[" : ",\n[";
    append_decimals(text, rows.row(row), ',');
    text += ']';
  }
  text += ']';
}

template <typename Values>
void append_list(std::string& text, const char* name, const Values& values) {
  text.append(",\n\"").append(name).append("\": [");
  append_decimals(text, values, ',');
  text += ']';
}

/// An object for each branch on a line of its own. A life of null stays at every level.
void append_branches(std::string& text, const CurveSkeleton& skeleton) {
  const std::vector<Branch> all = branches(skeleton);
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  text += ",\n\"branches\": [";
  for (std::size_t b = 0; b < all.size(); ++b) {
    text += b == 0 ? "\n{\"nodes\": [" : ",\n{\"nodes\": [";
    append_decimals(text, all[b].nodes, ',');
    text += ']';
    if (has_lives(skeleton)) {
      text += ", \"life\": ";
      if (levels[b].life < lives_for_ever) {
        append_decimal(text, levels[b].life);
      } else {
        text += "null";
      }
      text += ", \"parent\": ";
      if (levels[b].parent >= 0) {
        append_decimal(text, levels[b].parent);
      } else {
        text += "null";
      }
    }
    if (levels[b].merge >= 0) {
      text += ", \"merge\": ";
      append_decimal(text, levels[b].merge);
    }
    text += '}';
  }
  text += ']';
}

/// Of a text that is one JSON object the names of its members, of others nothing. No value is kept,
/// as reports of many components are long.
std::optional<std::vector<std::string>> member_names(const std::string& text) {
  using Event = nlohmann::json::parse_event_t;
  std::vector<std::string> names;
  const auto note = [&](int depth, Event event, nlohmann::json& parsed) {
    if (depth == 1 && event == Event::key) names.push_back(parsed.get<std::string>());
    return depth == 0;
  };
  constexpr bool throws = false;
  if (!nlohmann::json::parse(text, note, throws).is_object()) return std::nullopt;
  return names;
}

/// The members of the report object as they are, each after a comma.
void append_report(std::string& text, const std::string& report_json) {
  if (report_json.empty()) return;
  const std::optional<std::vector<std::string>> names = member_names(report_json);
  if (!names) {
    throw Error(Fault::output,
                "the report for the JSON skeleton is no JSON object, needed one; pass {...}");
  }
  constexpr std::array<std::string_view, 10> own{
      "format", "version", "provenance",     "nodes", "edges",
      "radii",  "lives",   "node_of_vertex", "root",  "branches"};
  for (const std::string& name : *names) {
    if (std::find(own.begin(), own.end(), name) != own.end()) {
      throw Error(Fault::output, "the report for the JSON skeleton has a member \"" + name +
                                     "\", needed other names than the skeleton's own; rename it");
    }
  }
  if (names->empty()) return;
  constexpr const char* space = " \t\r\n";
  const std::size_t first = report_json.find_first_not_of(space, report_json.find('{') + 1);
  const std::size_t last = report_json.find_last_not_of(space, report_json.rfind('}') - 1);
  text.append(",\n").append(report_json, first, last - first + 1);
}

}  // namespace

std::string json_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  std::string text = "{\n\"format\": \"curveskel skeleton\",\n\"version\": 1";
  text +=
      ",\n\"provenance\": " + nlohmann::json(context.provenance)
                                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  append_report(text, context.report_json);
  if (context.root >= 0) text += ",\n\"root\": " + std::to_string(context.root);
  append_rows(text, "nodes", skeleton.nodes);
  append_rows(text, "edges", skeleton.edges);
  append_list(text, "radii", skeleton.radii);
  append_list(text, "lives", skeleton.lives);
  append_branches(text, skeleton);
  append_list(text, "node_of_vertex", skeleton.node_of_vertex);
  return text + "\n}\n";
}

}  // namespace curveskel
