// The patch round a vertex: all that lies within some edges of it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>
#include "contraction/fairing/one_rings.hpp"

namespace curveskel {

/// The vertices within K edges of a centre, and the faces that have a corner within K - 1: for
/// K = 1 the fan of the centre.
struct Patch {
  std::vector<std::int32_t> vertices;                  ///< of the surface; the centre is the first
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< indices into `vertices`
};

/// Finds patches one at a time, so that those of a whole surface are never in memory together.
/// Keeps O(#V) of scratch: one for each thread. The surface's arrays must outlive it.
class PatchFinder {
 public:
  PatchFinder(const Triangles& triangles, const CornersByVertex& corners, int rings);

  /// Valid until the next call. The order depends on the surface alone. Faces that have a vertex
  /// twice are left out. O(size of the patch).
  [[nodiscard]] const Patch& of(std::int32_t centre);

 private:
  void add_faces_of(std::int32_t local);

  const Triangles& triangles_;
  const CornersByVertex& corners_;
  int rings_;
  std::vector<std::int32_t> local_;  // index in the patch, -1 = not in it
  Patch patch_;
};

}  // namespace curveskel
