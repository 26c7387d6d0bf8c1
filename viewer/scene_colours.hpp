// What is shown of a skeleton and its surface, coloured as a person wants it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "rig/rig.hpp"
#include "skeleton/curve_skeleton.hpp"
#include "surface/surface.hpp"
#include "viewer/look.hpp"
#include "viewer/shapes_shown.hpp"

namespace curveskel::viewer {

/// The range that a colour bar spells out.
struct ColourScale {
  float low = 0;
  float high = 1;
  bool operator==(const ColourScale&) const = default;
};

/// What is lit up, by index.
struct Highlights {
  std::vector<int> nodes;
  std::vector<int> edges;
  std::vector<int> failed_edges;  ///< outside, or spurs
  int joint = -1;                 ///< of the rig: its weights are shown; -1 = those of all
  std::vector<int> failed_faces;  ///< of the given surface: what had to be repaired
  bool operator==(const Highlights&) const = default;
};

/// Connected parts, numbered in the order of their first vertices; a vertex without a face is part
/// of none (-1). O(#V + #F).
[[nodiscard]] std::vector<int> components_of(const Surface& surface);
/// #N of the skeleton, the same for its edges.
[[nodiscard]] std::vector<int> components_of(const CurveSkeleton& skeleton);
/// Lowest and highest radius; nothing without radii.
[[nodiscard]] std::optional<ColourScale> radius_scale(const CurveSkeleton& skeleton);

/// `size` is the diagonal of all that is shown.
[[nodiscard]] ShownSkeleton shown_skeleton(const CurveSkeleton& skeleton,
                                           const Eigen::RowVector3d& origin, float size,
                                           const Look& look, const Highlights& highlights);

/// Bones from each joint to those below it, and joints as balls.
[[nodiscard]] ShownSkeleton shown_rig(const Rig& rig, const Eigen::RowVector3d& origin, float size,
                                      const Look& look, const Highlights& highlights);

/// What a surface's colours may come from; either may be null, and what is not of this surface's
/// vertices is passed over.
struct Meaning {
  const CurveSkeleton* skeleton = nullptr;
  const Rig* rig = nullptr;
};
/// One colour per vertex of `surface`; empty where it is plain. Vertices of the highlighted nodes
/// are lit up.
[[nodiscard]] std::vector<Rgba> surface_colours(const Surface& surface, const Meaning& meaning,
                                                const Look& look, const Highlights& highlights);

}  // namespace curveskel::viewer
