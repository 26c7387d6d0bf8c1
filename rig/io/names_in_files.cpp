#include <algorithm>
#include <array>
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

std::string as_word(std::string name) {
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code <= ' ' || code == 127) c = '_';
  }
  return name;
}

}  // namespace

std::vector<std::string> names_as_words(const Rig& rig) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    std::string name = as_word(as_utf8(rig.names[static_cast<std::size_t>(joint)]));
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
