#include "surface/repair/sound_repaired.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/error.hpp>

namespace curveskel {

void require_sound(const RepairedSurface& repaired, std::string_view purpose) {
  require_corners(repaired.surface, purpose);
  const Eigen::Index vertices = repaired.surface.positions.rows();
  const auto refuse = [&](const std::string& found, int vertex, const std::string& or_none) {
    throw Error(Fault::input, std::string(purpose) + ": found " + found + " vertex " +
                                  std::to_string(vertex) + ", needed one of the surface's " +
                                  std::to_string(vertices) + or_none);
  };
  const auto require_vertices = [&](const std::vector<std::int32_t>& all, const char* found) {
    const auto wrong = std::find_if(all.begin(), all.end(),
                                    [&](std::int32_t v) { return v < 0 || v >= vertices; });
    if (wrong != all.end()) refuse(found, *wrong, "");
  };
  for (const int v : repaired.vertex_of_input) {
    if (v >= vertices) refuse("a vertex of the file at", v, ", or -1 for none");
  }
  for (const auto& rim : repaired.rims) require_vertices(rim, "a rim with");
  require_vertices(repaired.sheets, "a sheet with");
}

}  // namespace curveskel
