// More vertices, same shape.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// Splits the longest edges until there are at least `least_vertices`, seldom twice as many and
/// never many more (what is cut may be equally long), however long and thin the triangles are, so
/// that edges become even in length; a surface with enough vertices is left as it is, and so is one
/// without area. The surface stays where it is; vertices keep their index, new ones follow.
/// O(`least_vertices` log `least_vertices`) for each factor of 0.85 in between. Precondition:
/// closed oriented 2-manifold.
[[nodiscard]] Surface refine(const Surface& surface, int least_vertices);

}  // namespace curveskel
