// Parts and samples of what is matched.
#pragma once

#include <cstddef>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// All, or `most` of them evenly through the list.
[[nodiscard]] std::vector<int> evenly(const std::vector<int>& all, std::size_t most);

struct SurfacePart {
  std::vector<int> vertices;  ///< of the whole surface
  Surface surface;
};

/// Some faces as a surface of their own. O(#faces log #faces).
[[nodiscard]] SurfacePart part_of(const Surface& surface, const std::vector<int>& faces);

}  // namespace curveskel
