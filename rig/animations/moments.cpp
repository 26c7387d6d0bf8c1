#include "rig/animations/moments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace curveskel {

std::vector<double> sorted_moments(std::vector<double> keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

std::vector<double> moments_between(std::vector<double> keys) {
  constexpr double frames_a_second = 30;
  constexpr double rounding = 1e-3;  // of a frame: keys at frames get none between them
  constexpr double most = 1000;
  keys = sorted_moments(std::move(keys));
  std::vector<double> all;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const double length = keys[k + 1] - keys[k];
    const double wanted = std::ceil(length * frames_a_second - rounding);
    const auto parts = static_cast<int>(std::clamp(wanted, 1.0, most));
    for (int part = 0; part < parts; ++part) {
      all.push_back(keys[k] + part / static_cast<double>(parts) * length);
    }
  }
  if (!keys.empty()) all.push_back(keys.back());
  return all;
}

}  // namespace curveskel
