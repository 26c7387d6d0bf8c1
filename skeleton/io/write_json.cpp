#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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
class MemberNames : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] static std::optional<std::vector<std::string>> of(const std::string& text) {
    MemberNames members;
    if (!nlohmann::json::sax_parse(text, &members) || !members.is_object_) return std::nullopt;
    return std::move(members.names_);
  }

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(std::int64_t /*value*/) override { return true; }
  bool number_unsigned(std::uint64_t /*value*/) override { return true; }
  bool number_float(double /*value*/, const std::string& /*text*/) override { return true; }
  bool string(std::string& /*value*/) override { return true; }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*members*/) override {
    is_object_ = is_object_ || depth_ == 0;
    ++depth_;
    return true;
  }
  bool key(std::string& name) override {
    if (depth_ == 1) names_.push_back(name);
    return true;
  }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t /*values*/) override {
    ++depth_;
    return true;
  }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t /*place*/, const std::string& /*token*/,
                   const nlohmann::json::exception& /*error*/) override {
    return false;
  }

 private:
  int depth_ = 0;
  bool is_object_ = false;
  std::vector<std::string> names_;
};

/// The members of the report object as they are, each after a comma.
void append_report(std::string& text, const std::string& report_json) {
  if (report_json.empty()) return;
  const std::optional<std::vector<std::string>> names = MemberNames::of(report_json);
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
