// Surfaces that no point is inside of: triangles at random, as of a file whose faces have the
// numbers of other vertices, or whose vertices stand in another order.
#pragma once

#include <curveskel/surface.hpp>

namespace curveskel {

/// How often a line through the box of the surface meets, in the mean, a long face, one with an
/// edge of a tenth of the box's diagonal or more: twice the area of these faces over that of the
/// box (Cauchy). 2 for a box; at most 3 of the surfaces that were looked at; 13 and more where
/// every tenth vertex has the place of another. Noise, be it ever so dense, has short edges. O(#F).
[[nodiscard]] double long_faces_on_a_line(const Surface& surface);

/// The share of edges that pass through a face which none of their ends is a corner of: .92 of
/// random triangles, .3 to .6 where noise is as thick as the limbs. Asks up to 1,000 edges of
/// `least_edge` or more, evenly spread over the triangles; 0 without such. O(#F log #F).
[[nodiscard]] double crossing_share(const Surface& surface, double least_edge = 0);

/// True where nearly all edges pass through other faces: of a surface that `was_cut_much`, as its
/// faces would not fit together, all edges; of any, the long ones, if lines meet its long faces
/// again and again. O(#F), of a tangle O(#F log #F).
[[nodiscard]] bool is_tangle(const Surface& surface, bool was_cut_much);

/// True if parts with more than half of the area are tangles, cut or not. Any faces. O(#F) if no
/// part has long faces again and again.
[[nodiscard]] bool is_mostly_tangle(const Surface& surface);

}  // namespace curveskel
