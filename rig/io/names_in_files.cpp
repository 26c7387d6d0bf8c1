#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/free_name.hpp"
#include "base/utf8.hpp"
#include "rig/io/rig_formats.hpp"
#include "rig/io/rig_writers.hpp"

namespace curveskel {
namespace {

std::string by_rule(std::string name, NameRule rule) {
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    const bool fits =
        rule == NameRule::word ? code > ' ' && code != 127 : std::isalnum(code) != 0 && code < 128;
    if (!fits) c = '_';
  }
  const bool digit_first = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) != 0;
  return rule == NameRule::identifier && digit_first ? "_" + name : name;
}

}  // namespace

std::vector<std::string> names_by(const Rig& rig, NameRule rule) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    std::string name = by_rule(as_utf8(rig.names[static_cast<std::size_t>(joint)]), rule);
    if (name.empty()) name = "joint_" + std::to_string(joint + 1);
    names.push_back(free_name(taken, name, "_"));
  }
  return names;
}

FourWeights four_weights(const SkinWeights& weights, Eigen::Index vertex) {
  std::vector<std::pair<float, int>> row;
  for (SkinWeights::InnerIterator it(weights, vertex); it; ++it) {
    if (it.value() > 0) row.emplace_back(it.value(), static_cast<int>(it.col()));
  }
  std::stable_sort(row.begin(), row.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  row.resize(std::min<std::size_t>(row.size(), 4));
  FourWeights four;
  if (row.empty()) row.emplace_back(1.0F, 0);
  float sum = 0;
  for (const auto& [weight, joint] : row) sum += weight;
  for (std::size_t k = 0; k < row.size(); ++k) {
    four.joints[k] = row[k].second;
    four.weights[k] = row[k].first / sum;
  }
  return four;
}

}  // namespace curveskel
