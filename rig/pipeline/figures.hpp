// The figures of a scene, each with a plan of its own. Internal to rig/.
#pragma once

#include <stop_token>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/role_names.hpp>
#include "rig/pipeline/divided_body.hpp"

namespace curveskel {

/// One figure as if it were alone in the file.
struct Figure {
  RepairedSurface body;
  CurveSkeleton skeleton;
  BodyPlan plan;
  OwnInputs inputs = {};
};

/// `find_plan` of the body without the components that were made of sheets, if that is a humanoid's
/// or a quadruped's: capes and manes are no limbs. Else of all, as a bird's wings may be sheets. Of
/// the largest component alone where nothing clear is seen of all, or only in a pose and less alike
/// on both sides: swords and shields are no limbs. Joints have nodes of the whole skeleton.
[[nodiscard]] BodyPlan plan_of_figure(const RepairedSurface& body, const CurveSkeleton& skeleton,
                                      const PlanOptions& options);

struct FigureOptions {
  PlanOptions plan;
  int threads = 0;  ///< 0 = all
};

/// The nodes to whose component some vertex of the body collapsed, or nothing
/// at all; ascending.
[[nodiscard]] std::vector<int> nodes_of_body(const CurveSkeleton& skeleton, const RigParts& parts);

/// The bodies that stand clear of one another (their boxes do not meet) and are
/// each built to a plan, the largest first; a single one unless the whole has a
/// plan of more joints. Where neither has a plan, those that there are without
/// the component of the largest area, which may be the ground, and at last all
/// that stands on it as one. All else goes with the figure whose box is nearest.
/// Else the whole body is the only figure. Of a scene that is not made of tubes
/// each group is judged alone. `skeleton` has node_of_vertex, by the body's
/// vertices; without it there is one figure. Throws Cancelled on a stop.
/// Each group is looked at once, in the time that its own size takes; pairs of boxes that meet come
/// on top, in the worst case the square of the number of components.
[[nodiscard]] std::vector<Figure> find_figures(const RepairedSurface& body,
                                               const CurveSkeleton& skeleton,
                                               const FigureOptions& options,
                                               const std::stop_token& stop = {});

/// A rig, and the surface and skeleton that it is of.
struct RiggedBody {
  RepairedSurface body;
  CurveSkeleton skeleton;
  Rig rig;
  OwnInputs inputs = {};
};

/// All figures side by side: the joints of the first keep names and roles,
/// those of the k-th begin with "figure<k>_", as programs expect one of each.
/// `inputs` is the file's number of vertices, by all of which the result is.
[[nodiscard]] RiggedBody side_by_side(std::vector<RiggedBody> figures, Eigen::Index inputs);

}  // namespace curveskel
