#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/utf8.hpp"
#include "rig/io/rig_writers.hpp"
#include "rig/joints/bone_axes.hpp"
#include "rig/skin/four_weights.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

/// One row a line: what a person looks at, and a program compares.
template <typename Row>
std::string lines(Eigen::Index count, const Row& row) {
  std::string text = "[";
  for (Eigen::Index k = 0; k < count; ++k) text += (k == 0 ? "\n" : ",\n") + row(k);
  return text + "\n]";
}

Json direction(const Eigen::Vector3d& unit) {
  constexpr double digits = 1e6;
  Json numbers = Json::array();
  for (const double number : unit) numbers.push_back(std::round(number * digits) / digits + 0.0);
  return numbers;
}

/// At tips, which show how long the last bone is.
std::vector<bool> moves_nothing(const Rig& rig) {
  std::vector<bool> nothing(idx(rig.parents.size()), true);
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    for (SkinWeights::InnerIterator it(rig.weights, v); it; ++it) nothing[idx(it.col())] = false;
  }
  for (const int parent : rig.parents) {
    if (parent >= 0) nothing[idx(parent)] = false;
  }
  return nothing;
}

class JointLines {
 public:
  explicit JointLines(const Rig& rig)
      : rig_(rig), axes_(bone_axes(rig)), is_end_(moves_nothing(rig)) {}

  [[nodiscard]] std::string line(Eigen::Index joint) const {
    const auto place = rig_.joints.row(joint);
    Json line = {{"name", as_utf8(rig_.names[idx(joint)])},
                 {"parent", rig_.parents[joint]},
                 {"position", {place.x(), place.y(), place.z()}},
                 {"axis", direction(axes_[idx(joint)] * Eigen::Vector3d::UnitY())}};
    if (is_end_[idx(joint)]) line["end"] = true;
    if (!rig_.roles.empty() && !rig_.roles[idx(joint)].empty()) {
      line["role"] = as_utf8(rig_.roles[idx(joint)]);
    }
    return line.dump();
  }

 private:
  const Rig& rig_;
  const std::vector<Eigen::Quaterniond> axes_;
  const std::vector<bool> is_end_;
};

}  // namespace

std::string format_json_rig(const Rig& rig, const std::string& provenance) {
  const Eigen::Index vertices = rig.weights.rows();
  const auto row_of = [](const auto& four) {
    std::string text = "[";
    for (std::size_t k = 0; k < 4; ++k) {
      text += k == 0 ? "" : ",";
      if constexpr (std::is_same_v<std::decay_t<decltype(four[0])>, float>) {
        text += number_text(four[k]);
      } else {
        text += std::to_string(four[k]);
      }
    }
    return text + "]";
  };
  const JointLines joints(rig);
  return "{\"format\": \"curveskel-rig\", \"version\": 1, \"generator\": " +
         Json(as_utf8(provenance)).dump() + ",\n\"joints\": " +
         lines(rig.joints.rows(), [&](Eigen::Index k) { return joints.line(k); }) +
         ",\n\"vertices\": " + std::to_string(vertices) + ",\n\"weights\": {\"joints\": " +
         lines(vertices,
               [&](Eigen::Index v) { return row_of(four_weights(rig.weights, v).joints); }) +
         ",\n\"values\": " +
         lines(vertices,
               [&](Eigen::Index v) { return row_of(four_weights(rig.weights, v).weights); }) +
         "}}\n";
}

}  // namespace curveskel
