// The peer: CGAL's mean curvature flow skeletonization (Tagliasacchi et al. 2012).
#pragma once

#include <filesystem>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel::bench {

/// Reads the surface by CGAL's own readers where they know the format (OFF, OBJ, ASCII or binary
/// PLY) and by this project's otherwise, triangulates, turns it outward, and skeletonizes each
/// component with CGAL's defaults. One thread. Throws std::exception where CGAL or reading fails.
[[nodiscard]] CurveSkeleton cgal_skeleton(const std::filesystem::path& file);

/// The same of a clean surface.
[[nodiscard]] CurveSkeleton cgal_skeleton(const Surface& surface);

}  // namespace curveskel::bench
