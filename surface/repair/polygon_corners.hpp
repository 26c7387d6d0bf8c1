// One polygon of a soup.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <curveskel/read.hpp>

namespace curveskel {

/// The vertices round polygon number `p`. Precondition: the soup has it.
[[nodiscard]] inline std::span<const std::int32_t> corners_of_polygon(const PolygonSoup& soup,
                                                                      std::size_t p) {
  const auto begin = static_cast<std::size_t>(soup.offsets[p]);
  return std::span(soup.corners)
      .subspan(begin, static_cast<std::size_t>(soup.offsets[p + 1]) - begin);
}

}  // namespace curveskel
