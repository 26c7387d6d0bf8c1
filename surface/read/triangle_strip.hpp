// Strips of triangles taken apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "surface/read/formats.hpp"

namespace curveskel {

/// Every second triangle is turned round, as VTK and PLY have them; fewer than three corners give
/// none.
inline void append_strip(std::span<const std::int32_t> strip, PolygonSoup& soup) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const std::size_t turned = i % 2;
    soup.corners.insert(soup.corners.end(),
                        {strip[i + turned], strip[i + 1 - turned], strip[i + 2]});
    end_polygon(soup);
  }
}

}  // namespace curveskel
