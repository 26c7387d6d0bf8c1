#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include <curveskel/error.hpp>
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

/// The members of the report object, each as `, "key": value`.
void append_report(std::string& text, const std::string& report_json) {
  if (report_json.empty()) return;
  const auto report = nlohmann::ordered_json::parse(report_json, nullptr, false);
  if (!report.is_object()) {
    throw Error(Fault::output,
                "the report for the JSON skeleton is no JSON object, needed one; pass {...}");
  }
  constexpr std::array<std::string_view, 8> own{"format", "version", "provenance",     "nodes",
                                                "edges",  "radii",   "node_of_vertex", "root"};
  for (const auto& [key, value] : report.items()) {
    if (std::find(own.begin(), own.end(), key) != own.end()) {
      throw Error(Fault::output, "the report for the JSON skeleton has a member \"" + key +
                                     "\", needed other names than the skeleton's own; rename it");
    }
    text += ",\n" + nlohmann::json(key).dump() + ": " + value.dump(1);
  }
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
  append_list(text, "node_of_vertex", skeleton.node_of_vertex);
  return text + "\n}\n";
}

}  // namespace curveskel
