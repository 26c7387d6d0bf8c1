// The way to make a component from all its vertices, just below the surface where it has to be.
#pragma once

#include <curveskel/extract.hpp>

namespace curveskel {

[[nodiscard]] inline ExtractOptions with_all_vertices(ExtractOptions options) {
  options.resolution = 0;
  options.embed.go_below = true;
  return options;
}

[[nodiscard]] inline bool is_quick_with_all(int vertices) {
  constexpr int most = 80000;  // they take 10 s of the processor
  return vertices <= most;
}

}  // namespace curveskel
