// The shown parts of a skeleton and its surface, in the colours that a person chose.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/surface.hpp>
#include "viewer/model/drawn_materials.hpp"
#include "viewer/render/look.hpp"
#include "viewer/render/shapes_shown.hpp"

namespace curveskel::viewer {

/// The range that a colour bar spells out.
struct ColourScale {
  float low = 0;
  float high = 1;
  bool operator==(const ColourScale&) const = default;
};

/// Elements that are lit up, by index.
struct Highlights {
  std::vector<int> nodes;
  std::vector<int> edges;
  std::vector<int> failed_edges;  ///< outside, or spurs
  int joint = -1;                 ///< of the rig: its weights are shown; -1 = those of all
  std::vector<int> failed_faces;  ///< of the given surface: those that had to be repaired
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
[[nodiscard]] ShownSkeleton shown_skeleton(const CurveSkeleton& skeleton, const DrawnSpace& space,
                                           float size, const Look& look,
                                           const Highlights& highlights);

/// Bones from each joint to those below it, and joints as balls. `joints` are the rig's where they
/// stand now.
[[nodiscard]] ShownSkeleton shown_rig(const Rig& rig, const Positions& joints,
                                      const DrawnSpace& space, float size, const Look& look,
                                      const Highlights& highlights);

/// Sources of a surface's colours; each may be null. Values that are not of this surface's
/// vertices are passed over.
struct Meaning {
  const CurveSkeleton* skeleton = nullptr;
  const Rig* rig = nullptr;
  const RigParts* parts = nullptr;  ///< part_of_vertex by the surface's vertices
  const DrawnMaterials* materials = nullptr;
};
/// One colour per vertex of `surface`; empty where it is plain. Vertices of the highlighted nodes
/// are lit up.
[[nodiscard]] std::vector<Rgba> surface_colours(const Surface& surface, const Meaning& meaning,
                                                const Look& look, const Highlights& highlights);

}  // namespace curveskel::viewer
