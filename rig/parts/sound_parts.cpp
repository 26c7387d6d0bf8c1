#include "rig/parts/sound_parts.hpp"

#include <string>

#include <curveskel/error.hpp>

namespace curveskel {

void require_parts_of(const RigParts& parts, Eigen::Index vertices, std::string_view purpose) {
  const auto refuse = [&](const std::string& found, const std::string& needed) {
    throw Error(Fault::input, std::string(purpose) + ": found " + found + ", needed " + needed);
  };
  if (parts.part_of_vertex.size() != vertices) {
    refuse("parts of " + std::to_string(parts.part_of_vertex.size()) + " vertices",
           "those of the surface's " + std::to_string(vertices));
  }
  const auto count = static_cast<int>(parts.parts.size());
  for (Eigen::Index v = 0; v < vertices; ++v) {
    const int part = parts.part_of_vertex[v];
    if (part >= 0 && part < count) continue;
    refuse("part " + std::to_string(part) + " for vertex " + std::to_string(v),
           "one of " + std::to_string(count) + " parts");
  }
}

}  // namespace curveskel
