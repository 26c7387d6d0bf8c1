#include <nlohmann/json.hpp>

#include <string>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/skin_numbers.hpp"
#include "rig/io/rig_writers.hpp"

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

std::string joint_line(const Rig& rig, Eigen::Index joint) {
  const auto place = rig.joints.row(joint);
  Json line = {{"name", as_utf8(rig.names[idx(joint)])},
               {"parent", rig.parents[joint]},
               {"position", {place.x(), place.y(), place.z()}}};
  if (!rig.roles.empty() && !rig.roles[idx(joint)].empty()) line["role"] = rig.roles[idx(joint)];
  return line.dump();
}

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
  return "{\"format\": \"curveskel-rig\", \"version\": 1, \"generator\": " +
         Json(as_utf8(provenance)).dump() + ",\n\"joints\": " +
         lines(rig.joints.rows(), [&](Eigen::Index k) { return joint_line(rig, k); }) +
         ",\n\"vertices\": " + std::to_string(vertices) + ",\n\"weights\": {\"joints\": " +
         lines(vertices,
               [&](Eigen::Index v) { return row_of(four_weights(rig.weights, v).joints); }) +
         ",\n\"values\": " +
         lines(vertices,
               [&](Eigen::Index v) { return row_of(four_weights(rig.weights, v).weights); }) +
         "}}\n";
}

}  // namespace curveskel
