#include "rig/animations/track_moments.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "rig/animations/moments.hpp"

namespace curveskel {

std::vector<double> track_moments(const std::vector<const GltfTrack*>& tracks) {
  std::vector<double> keys;
  for (const GltfTrack* track : tracks) {
    keys.insert(keys.end(), track->times().begin(), track->times().end());
    if (track->between() != GltfTrack::Between::step) continue;
    for (std::size_t k = 1; k < track->times().size(); ++k) {
      const double before = track->times()[k - 1];
      const double now = track->times()[k];
      keys.push_back(std::max(now - step_seconds, 0.5 * (before + now)));
    }
  }
  return moments_between(std::move(keys));
}

}  // namespace curveskel
