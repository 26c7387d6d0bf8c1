// Demands on a surface, for the stages to end and to stay within their arrays, checked at the
// door.
#pragma once

#include <string_view>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Throws Error(Fault::input) unless there is a face, every corner is a vertex and every coordinate
/// is finite. The message begins with `purpose` ("fair") and names the first face or vertex at
/// fault. One pass over the arrays.
void require_sound(const Surface& surface, std::string_view purpose);

/// The same of corners alone: a surface without faces is let in, and coordinates are not looked at.
void require_corners(const Surface& surface, std::string_view purpose);

/// The same, and the surface must be closed and manifold: every edge lies in two faces that run
/// through it in opposite directions, every vertex has one fan of faces, no two faces have the same
/// three vertices. The message counts the open and the non-manifold edges and names the first. The
/// bounding box's diagonal must lie between 1e-150 and 1e150, or be 0, so that its square is a
/// number. Outwardness is not looked at. O(#V + #F), on `threads` threads (0 = one per core).
void require_closed_manifold(const Surface& surface, std::string_view purpose, int threads = 0);

}  // namespace curveskel
