// Skeletons and joints that somebody gives to be rigged.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig.hpp>

namespace curveskel {

/// Options of the program that would have no effect beside a skeleton that is given, beside joints,
/// and beside a rig that is kept: refused there.
inline constexpr std::array idle_beside_skeleton{"detail", "fair"};
inline constexpr std::array idle_beside_joints{"bone-length", "follow", "front", "joint-budget",
                                               "names",       "plan",   "pose",  "root"};
inline constexpr std::array idle_beside_kept_rig{"ground-root", "up"};

/// Throws Error(Fault::input) where the skeleton is mostly elsewhere, or has nodes for other
/// vertices than the surface's. `name` is for messages.
void require_skeleton_of(const PolygonSoup& soup, const CurveSkeleton& skeleton,
                         const std::string& name);

/// FBX and COLLADA become other files: a rig that is kept is made anew of the joints that they had.
[[nodiscard]] bool keeps_joints_alone(SurfaceFormat format);

/// The rig that a file of this format has, or its joints alone; they are the surface's, wherever
/// they lie. Throws Error(Fault::input) where there is none.
[[nodiscard]] Rig rig_in(const std::filesystem::path& mesh, SurfaceFormat format,
                         const Monitor& monitor);

/// Of joints or nodes beside a surface.
struct PointPlaces {
  bool any_within = true;   ///< of the surface's box
  bool most_within = true;  ///< the same
  std::string finding;      ///< where most lie outside, and by which unit not
};

/// `positions` are the surface's vertices; `kind` ("joints") and the points' `file` are for the
/// message.
[[nodiscard]] PointPlaces places_of(const Positions& points, std::string_view kind,
                                    const Positions& positions, const std::filesystem::path& file);

struct GivenJoints {
  Rig rig;
  std::string finding;  ///< where most lie outside of the surface's box, and by which unit not
};

/// The joints in a file. Of an artist's rig some may lie outside of the surface's box: a root on
/// the ground, handles. Throws Error(Fault::input) where all do.
[[nodiscard]] GivenJoints joints_for(const std::filesystem::path& file, const PolygonSoup& soup,
                                     const Monitor& monitor);

}  // namespace curveskel
