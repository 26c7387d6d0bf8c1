#include "viewer/model/rigging.hpp"

#include <utility>

namespace curveskel::viewer {

std::shared_ptr<const Rig> rig_of(const Document& document, const RepairedSurface& repaired,
                                  const CurveSkeleton& skeleton, const RigOptions& options,
                                  const Monitor& monitor) {
  const CurveSkeleton mapped =
      skeleton_of_repaired(skeleton, repaired.vertex_of_input, repaired.surface.positions.rows());
  RigOptions facing = options;
  facing.faces_minus_z = document.faces_minus_z;
  return std::make_shared<const Rig>(
      rig_of_given(make_rig(repaired.surface, mapped, facing, monitor), repaired.surface, mapped,
                   repaired.vertex_of_input, document.surface));
}

Moment moment_of(std::shared_ptr<const Rig> rig) {
  Moment moment;
  moment.stage = "rig";
  moment.rig = std::move(rig);
  return moment;
}

}  // namespace curveskel::viewer
