// The device that the local flow runs on, and the layout of positions in its memory.
#pragma once

#include <cstddef>
#include <vector>

#include <curveskel/fair.hpp>

namespace curveskel {

/// Index into devices(). Throws Error(Fault::device), which names the method that works instead.
[[nodiscard]] std::size_t fairing_device(const FairOptions& options);

/// Four numbers a vertex, the last 0.
template <typename Real>
[[nodiscard]] std::vector<Real> pack_positions(const Positions& positions) {
  std::vector<Real> packed(4 * static_cast<std::size_t>(positions.rows()), 0);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    for (int k = 0; k < 3; ++k) {
      packed[static_cast<std::size_t>(4 * v + k)] = static_cast<Real>(positions(v, k));
    }
  }
  return packed;
}

template <typename Real>
[[nodiscard]] Positions unpack_positions(const std::vector<Real>& packed) {
  Positions positions(static_cast<Eigen::Index>(packed.size() / 4), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    for (int k = 0; k < 3; ++k) {
      positions(v, k) = static_cast<double>(packed[static_cast<std::size_t>(4 * v + k)]);
    }
  }
  return positions;
}

}  // namespace curveskel
