#include <curveskel/make_rig.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/error.hpp>
#include "rig/joints/drawn_inside.hpp"
#include "rig/joints/fully_mapped.hpp"
#include "rig/joints/ground_nodes.hpp"
#include "rig/joints/idle_joints.hpp"
#include "rig/joints/sides.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/joints/standing_joints.hpp"
#include "rig/skin/skin_bones.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {

void require_valid(const RigOptions& options) {
  require_valid(options.joints);
  require_valid(options.skin);
}

Rig make_rig(const Surface& surface, const CurveSkeleton& skeleton, const RigOptions& options,
             const Monitor& monitor) {
  const Eigen::Index count = surface.positions.rows();
  return without_idle_joints(make_planned_rig(surface, skeleton, BodyPlan{}, options, monitor), 0,
                             Eigen::VectorXi::LinSpaced(count, 0, static_cast<int>(count) - 1));
}

Rig make_planned_rig(const Surface& surface, const CurveSkeleton& skeleton, const BodyPlan& plan,
                     const RigOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "make_rig", options.skin.threads);
  require_sound_places(skeleton, "make_rig");
  require_vertices_of(skeleton, surface, "make_rig");
  monitor.report("joints", 0);
  Joints joints = plan.by_proportion
                      ? standing_joints(surface, skeleton, plan.joints, options.skin.threads)
                      : place_planned_joints(skeleton, plan.joints, options.joints,
                                             ground_nodes(surface, skeleton, plan),
                                             plan.axes.row(1).transpose());
  if (!plan.by_proportion) draw_inside(joints, surface, skeleton, options.skin.threads);
  Rig rig;
  const auto count = static_cast<int>(joints.parents.size());
  rig.weights = skin_weights(
      surface, fully_mapped(surface, skeleton, options.skin.threads, monitor), joints.joint_of_node,
      plan.by_proportion ? bones_for_all(joints.positions, joints.parents)
                         : bones_of_own(skeleton, joints),
      count, options.skin, monitor);
  rig.joints = std::move(joints.positions);
  rig.parents = std::move(joints.parents);
  rig.names = std::move(joints.names);
  const Eigen::Vector3d usual =
      options.faces_minus_z ? -Eigen::Vector3d::UnitX().eval() : Eigen::Vector3d::UnitX().eval();
  name_sides(rig, plan.joints.empty() ? usual : plan.axes.row(0).transpose().eval());
  rig.roles.resize(rig.names.size());
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    rig.names[k] = rig.roles[k] = plan.joints[k].role;
  }
  return rig;
}

Rig weights_on_joints(const Surface& surface, const CurveSkeleton& skeleton, const Rig& given,
                      const SkinOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "weights_on_joints", options.threads);
  require_sound(skeleton, "weights_on_joints");
  require_vertices_of(skeleton, surface, "weights_on_joints");
  require_hierarchy(given, "weights_on_joints");
  if (given.joints.rows() == 0) {
    throw Error(Fault::input, "weights_on_joints: the rig has no joints, needed at least one");
  }
  if (!given.joints.allFinite()) {
    throw Error(Fault::input,
                "weights_on_joints: the rig has a joint at a place that is no finite "
                "number, needed finite ones");
  }
  monitor.report("joints", 0);
  Rig rig{given.joints, given.parents,  given.names,  {}, given.roles,
          {},           given.readable, given.to_y_up};
  const std::vector<Bone> bones = bones_of_given(surface, given, options.threads);
  rig.weights = skin_weights(surface, fully_mapped(surface, skeleton, options.threads, monitor),
                             joints_of_nodes(skeleton, bones), bones,
                             static_cast<int>(given.joints.rows()), options, monitor);
  return rig;
}

CurveSkeleton skeleton_of_repaired(CurveSkeleton skeleton, const Eigen::VectorXi& vertex_of_input,
                                   Eigen::Index vertices) {
  const Eigen::VectorXi given = skeleton.node_of_vertex;
  if (given.size() == 0) return skeleton;
  if (given.size() != vertex_of_input.size()) {
    throw Error(Fault::input, "the skeleton has a node for each of " +
                                  std::to_string(given.size()) + " vertices, needed one for each " +
                                  "of the surface's " + std::to_string(vertex_of_input.size()) +
                                  "; extract it again, from this surface");
  }
  require_below(vertex_of_input, vertices, "skeleton_of_repaired");
  skeleton.node_of_vertex.setConstant(vertices, -1);
  for (Eigen::Index v = 0; v < given.size(); ++v) {
    if (vertex_of_input[v] >= 0) skeleton.node_of_vertex[vertex_of_input[v]] = given[v];
  }
  return skeleton;
}

}  // namespace curveskel
