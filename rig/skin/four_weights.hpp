// The four weights of a vertex that files have. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Largest first, of sum 1; joints without a share are 0.
struct FourWeights {
  std::array<int, 4> joints{};
  std::array<float, 4> weights{};
};

/// The four largest weights above 0 of a vertex, of equal ones those of the first joints; joint 0
/// has all of a vertex without any. `joints`: the number of each of the rig's joints in the file,
/// several may have one, and its weight is their sum; -1 = none; empty = the same numbers.
[[nodiscard]] FourWeights four_weights(const SkinWeights& weights, Eigen::Index vertex,
                                       const std::vector<int>& joints = {});

}  // namespace curveskel
