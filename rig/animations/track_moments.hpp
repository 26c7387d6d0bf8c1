// The moments at which tracks of glTF are written in formats with lines between keys alone.
// Internal to rig/.
#pragma once

#include <vector>

#include "rig/gltf/gltf_animations.hpp"

namespace curveskel {

/// Keys of all tracks, those of steps twice, and times between them (see `moments_between`).
[[nodiscard]] std::vector<double> track_moments(const std::vector<const GltfTrack*>& tracks);

}  // namespace curveskel
