// Colours of what a rig's joints are.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel::viewer {

/// Of each joint that of its role, or of the nearest joint above it that has one; left ones are
/// lighter. A role has its colour in every rig.
[[nodiscard]] std::vector<glm::vec3> role_colours(const Rig& rig);

}  // namespace curveskel::viewer
