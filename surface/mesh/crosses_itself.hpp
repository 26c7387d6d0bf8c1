// The test for a surface that passes through itself.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// True if two triangles that share no vertex meet, or two neighbours overlap: then the surface has
/// no inside that all its handles and limbs bound. Exact. O(#F log #F + pairs that come near).
/// Precondition: closed oriented 2-manifold.
[[nodiscard]] bool crosses_itself(const Surface& surface);

}  // namespace curveskel
