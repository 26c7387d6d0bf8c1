#include "rig/animations/read_joint_animations.hpp"

#include "rig/dae/dae_joint_animations.hpp"
#include "rig/fbx/fbx_joint_animations.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {

AnimatedJoints read_joint_animations(const FileBytes& file, std::vector<std::string>& notes,
                                     const Monitor& monitor) {
  const auto format = surface_format_of(file);
  if (format == SurfaceFormat::fbx) return read_fbx_joint_animations(file, notes, monitor);
  if (format == SurfaceFormat::dae) return read_dae_joint_animations(file, monitor);
  return {};
}

}  // namespace curveskel
