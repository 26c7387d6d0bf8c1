// The shapes that are drawn many times over: see shaders/tube_vertex.glsl for their meaning.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace curveskel::viewer {

struct UnitShape {
  std::vector<glm::vec4> points;
  std::vector<std::uint32_t> corners;  ///< of triangles, counter-clockwise from outside
};

/// (cos, sin, 0, 0 or 1) round both ends.
[[nodiscard]] UnitShape unit_tube();
/// A sphere of latitudes and longitudes.
[[nodiscard]] UnitShape unit_ball();

}  // namespace curveskel::viewer
