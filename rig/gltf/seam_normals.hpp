// Normals of vertices for files that have to say some.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// Those of `vertex_normals`, of length 1; vertices in one place share theirs, or seams would be
/// seen as creases. Where there is none, 0 0 1. O(#V log #V + #F).
[[nodiscard]] Positions normals_across_seams(const Surface& surface);

}  // namespace curveskel
