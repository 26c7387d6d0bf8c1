// The sliders of an FBX geometry. Internal to surface/ and rig/.
#pragma once

#include <vector>

#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// A "BlendShapeChannel": a slider that leads through one shape or several, one after the other.
struct FbxChannel {
  struct Stop {
    const FbxRecord* shape;
    double percent;  ///< of the slider at which the shape is there in full, and no other
  };

  const FbxRecord* record;
  double percent = 0;       ///< that the file gives the slider
  std::vector<Stop> stops;  ///< at least one; percents ascend, from above 0

  /// How much of each stop's shape is there, 1 = all. Beyond the last its shape grows on.
  [[nodiscard]] std::vector<double> shares(double at_percent) const;
};

/// Those with shapes, in the file's order. Several shapes need a percentage each ("FullWeights"),
/// ascending; else the last is all that there is, at 100. O(channels).
[[nodiscard]] std::vector<FbxChannel> fbx_channels(const FileBytes& file, const FbxScene& scene,
                                                   const FbxRecord& geometry);

}  // namespace curveskel
