// The test for a surface that passes through itself.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// True if two triangles that share no vertex meet, or two neighbours overlap: then the surface has
/// no inside that all its handles and limbs bound. Exact. O(#F log #F + pairs that come near).
/// Precondition: closed oriented 2-manifold.
[[nodiscard]] bool crosses_itself(const Surface& surface);

/// The share of edges that pass through a face which none of their ends is a corner of: .92 of
/// random triangles, .3 to .6 where noise is as thick as the limbs. Asks up to 2,000 edges, evenly
/// spread over the triangles; 0 without triangles. O(#F log #F).
[[nodiscard]] double crossing_share(const Surface& surface);

}  // namespace curveskel
