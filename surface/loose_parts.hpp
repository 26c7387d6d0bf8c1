// Faces that hang together, whatever else they are.
#pragma once

#include <vector>

#include "surface/surface.hpp"

namespace curveskel {

/// Which faces share vertices, directly or by others.
struct LooseParts {
  std::vector<int> part_of_face;  ///< #F, numbered by the first face of each
  std::vector<double> areas;      ///< per part
};

/// Any faces: neither manifold nor closed. O(#F alpha(#F)).
[[nodiscard]] LooseParts loose_parts(const Surface& surface);

}  // namespace curveskel
