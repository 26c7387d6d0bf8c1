#include "rig/skin/four_weights.hpp"

#include <algorithm>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

FourWeights four_weights(const SkinWeights& weights, Eigen::Index vertex,
                         const std::vector<int>& joints) {
  std::vector<std::pair<float, int>> row;
  for (SkinWeights::InnerIterator it(weights, vertex); it; ++it) {
    const int joint = joints.empty() ? static_cast<int>(it.col()) : joints[idx(it.col())];
    if (joint < 0 || !(it.value() > 0)) continue;
    const auto same =
        std::find_if(row.begin(), row.end(), [&](const auto& one) { return one.second == joint; });
    if (same != row.end()) {
      same->first += it.value();
    } else {
      row.emplace_back(it.value(), joint);
    }
  }
  std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  FourWeights four;
  row.resize(std::min(row.size(), four.joints.size()));
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
