// Faces that hang together.
#pragma once

#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Faces that share vertices, directly or by others.
struct LooseParts {
  std::vector<int> part_of_face;  ///< #F, numbered by the first face of each
  std::vector<double> areas;      ///< per part
};

/// Any faces: neither manifold nor closed. O(#F alpha(#F)).
[[nodiscard]] LooseParts loose_parts(const Surface& surface);

}  // namespace curveskel
