#include "rig/joints/keep_joints.hpp"

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

std::vector<int> numbers_of(const std::vector<char>& stays) {
  std::vector<int> number(stays.size(), -1);
  int count = 0;
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    if (stays[joint] != 0) number[joint] = count++;
  }
  return number;
}

void mark_ancestors(const Rig& rig, std::vector<char>& stays) {
  for (Eigen::Index joint = rig.parents.size(); joint-- > 0;) {
    if (stays[idx(joint)] != 0 && rig.parents[joint] >= 0) stays[idx(rig.parents[joint])] = 1;
  }
}

Rig keep_joints(const Rig& rig, const std::vector<int>& number) {
  std::vector<int> kept;
  std::vector<int> stands_for(number.size());  // each joint's: its own number, or its ancestor's
  for (int joint = 0; joint < static_cast<int>(number.size()); ++joint) {
    const bool stays = number[idx(joint)] >= 0;
    if (stays) kept.push_back(joint);
    stands_for[idx(joint)] = stays ? number[idx(joint)] : stands_for[idx(rig.parents[joint])];
  }
  Rig result;
  result.to_y_up = rig.to_y_up;
  result.joints = rig.joints(kept, Eigen::all);
  result.parents.resize(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const int parent = rig.parents[kept[k]];
    result.parents[static_cast<Eigen::Index>(k)] = parent < 0 ? -1 : stands_for[idx(parent)];
    result.names.push_back(rig.names[idx(kept[k])]);
    if (!rig.roles.empty()) result.roles.push_back(rig.roles[idx(kept[k])]);
    if (!rig.readable.empty()) result.readable.push_back(rig.readable[idx(kept[k])]);
    if (!rig.turns.empty()) result.turns.push_back(rig.turns[idx(kept[k])]);
  }
  std::vector<Eigen::Triplet<float>> entries;
  entries.reserve(static_cast<std::size_t>(rig.weights.nonZeros()));
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      entries.emplace_back(static_cast<int>(vertex), stands_for[idx(it.col())], it.value());
    }
  }
  result.weights.resize(rig.weights.rows(), result.joints.rows());
  result.weights.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace curveskel
