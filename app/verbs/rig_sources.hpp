// Skeletons and joints that somebody gives `curveskel rig`.
#pragma once

#include <filesystem>
#include <string>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig.hpp>
#include "app/verbs/verbs.hpp"

namespace curveskel {

/// The skeleton in a file. Throws Error(Fault::input) where it is mostly elsewhere, or has nodes
/// for other vertices than the surface's.
[[nodiscard]] CurveSkeleton skeleton_for(const std::string& file, const PolygonSoup& soup);

/// The rig that a glTF file has. Throws Error(Fault::input) where there is none.
[[nodiscard]] Rig rig_in(const std::filesystem::path& mesh, const Monitor& monitor);

/// The joints in a file. Of an artist's rig some may lie outside of the surface's box: a root on
/// the ground, handles. Says so where most do, and by which unit they would not; throws
/// Error(Fault::input) where all do.
[[nodiscard]] Rig joints_for(const std::filesystem::path& file, const PolygonSoup& soup,
                             Session& session);

}  // namespace curveskel
