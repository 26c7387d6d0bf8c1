#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/topology.hpp>
#include "rig/pipeline/figures.hpp"
#include "rig/plan/curve_tree.hpp"
#include "rig/plan/role_words.hpp"
#include "surface/mesh/component_areas.hpp"

namespace curveskel {
namespace {

/// A component follows if it was made of a sheet.
RigParts sheets_follow(const RepairedSurface& body) {
  const Topology counted = topology(body.surface);
  RigParts parts;
  parts.part_of_vertex = counted.component_of_vertex;
  parts.parts.resize(idx(counted.components()));
  for (const std::int32_t v : body.sheets) parts.parts[idx(parts.part_of_vertex[v])].follows = true;
  return parts;
}

/// Of all components the largest is left, if it is most of the body; else all are.
RigParts all_but_largest_follow(const RepairedSurface& body) {
  const Topology counted = topology(body.surface);
  if (counted.components() < 2) return {};
  const std::vector<double> areas = component_areas(body.surface, counted);
  RigParts parts;
  parts.part_of_vertex = counted.component_of_vertex;
  parts.parts.resize(areas.size());
  const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
  if (2 * areas[idx(largest)] < std::accumulate(areas.begin(), areas.end(), 0.0)) return parts;
  for (std::size_t c = 0; c < areas.size(); ++c) {
    parts.parts[c].follows = static_cast<std::ptrdiff_t>(c) != largest;
  }
  return parts;
}

bool may_be_clear(BodyKind wanted) {
  return wanted == BodyKind::automatic || wanted == BodyKind::humanoid ||
         wanted == BodyKind::quadruped;
}

bool is_clear_and_whole(const BodyPlan& plan) {
  const bool is_clear = plan.plan == BodyKind::humanoid || plan.plan == BodyKind::quadruped;
  return is_clear && !plan.is_forced && plan.missing.empty();
}

/// By how much a bone and that of the other side differ, over the sum of both, at most.
double unlikeness_of_sides(const BodyPlan& plan) {
  std::map<std::string, double> lengths;
  for (const PlannedJoint& joint : plan.joints) {
    if (joint.parent < 0) continue;
    lengths[joint.role] = (joint.position - plan.joints[idx(joint.parent)].position).norm();
  }
  double most = 0;
  for (const auto& [role, left] : lengths) {
    const auto right = lengths.find(right_role(role));
    if (right == lengths.end()) continue;
    const double both = left + right->second;
    if (right->first != role && both > 0) {
      most = std::max(most, std::abs(left - right->second) / both);
    }
  }
  return most;
}

/// Of the parts that do not follow, by nodes of the whole skeleton.
BodyPlan plan_without_followers(const RepairedSurface& body, const CurveSkeleton& skeleton,
                                const RigParts& parts, const PlanOptions& options) {
  BodyPlan plan =
      find_plan(body_of(body, parts).surface, skeleton_of_body(skeleton, parts), options);
  const std::vector<int> nodes = nodes_of_body(skeleton, parts);
  for (PlannedJoint& joint : plan.joints) {
    if (joint.node >= 0) joint.node = nodes[idx(joint.node)];
  }
  return plan;
}

}  // namespace

BodyPlan plan_of_figure(const RepairedSurface& body, const CurveSkeleton& skeleton,
                        const PlanOptions& options) {
  const bool is_mapped = skeleton.node_of_vertex.size() > 0;
  if (!body.sheets.empty() && is_mapped) {
    BodyPlan plan = plan_without_followers(body, skeleton, sheets_follow(body), options);
    if (plan.plan == BodyKind::humanoid || plan.plan == BodyKind::quadruped) return plan;
  }
  PlanOptions with_sheets = options;
  with_sheets.sheets = body.sheets;
  BodyPlan plan = find_plan(body.surface, skeleton, with_sheets);
  const bool is_sure = is_clear_and_whole(plan);
  if ((is_sure && !plan.is_in_pose) || !is_mapped || !may_be_clear(options.plan)) return plan;
  const RigParts parts = all_but_largest_follow(body);
  if (parts.all_body()) return plan;
  BodyPlan alone = plan_without_followers(body, skeleton, parts, options);
  if (!is_clear_and_whole(alone)) return plan;
  if (is_sure && alone.plan == plan.plan &&
      unlikeness_of_sides(plan) <= std::max(most_unlike, unlikeness_of_sides(alone))) {
    return plan;
  }
  alone.reason.insert(0, "without the parts that hang from it: ");
  return alone;
}

}  // namespace curveskel
