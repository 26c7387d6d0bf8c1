#include "viewer/software/frame_times.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace curveskel::viewer {

double FrameTimes::percentile(double share) const {
  constexpr std::ptrdiff_t window = 300;
  const auto count = std::min(window, static_cast<std::ptrdiff_t>(all_.size()));
  if (count == 0) return 0;
  std::vector<double> recent(all_.end() - count, all_.end());
  const auto place = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(count))) - 1;
  const auto wanted = recent.begin() + std::clamp<std::ptrdiff_t>(place, 0, count - 1);
  std::nth_element(recent.begin(), wanted, recent.end());
  return *wanted;
}

std::string FrameTimes::text() const {
  std::string lines = "milliseconds\n";
  for (const double time : all_) lines += fmt::format("{:.3f}\n", time);
  return lines;
}

}  // namespace curveskel::viewer
