// OpenMesh's OM format, out.
#pragma once

#include <string>

#include <curveskel/surface.hpp>

namespace curveskel {

/// The bytes of an OM file: half-edges, positions in double precision, vertices and faces in their
/// order. Throws Error(Fault::output) naming the face where the faces are no oriented 2-manifold,
/// with or without boundary, as the format holds nothing else. O(#V + #F) for bounded valence.
[[nodiscard]] std::string format_om(const Surface& surface);

}  // namespace curveskel
