#include "app/rig_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/report.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::RowVector3d& point) { return {point.x(), point.y(), point.z()}; }

Json roles_of(const RigRecord& record) {
  Json roles = Json::object();
  for (std::size_t k = 0; k < record.plan.joints.size(); ++k) {
    const PlannedJoint& joint = record.plan.joints[k];
    roles[joint.role] = {{"joint", record.rig.names[k]},
                         {"number", k},
                         {"position", to_json(joint.position)},
                         {"reason", joint.reason}};
  }
  return roles;
}

Json parts_of(const RigParts& parts) {
  Json list = Json::array();
  for (const RigPart& part : parts.parts) {
    list.push_back({{"area_share", part.area_share},
                    {"kind", part.follows ? "follower" : "body"},
                    {"follows", part.host < 0 ? Json(nullptr) : Json(part.host)},
                    {"reach_in_radii", part.reach},
                    {"twin", part.twin < 0 ? Json(nullptr) : Json(part.twin)}});
  }
  return list;
}

Json joints_of(const Rig& rig) {
  Json list = Json::array();
  for (Eigen::Index j = 0; j < rig.joints.rows(); ++j) {
    list.push_back({{"name", rig.names[static_cast<std::size_t>(j)]},
                    {"parent", rig.parents[j] < 0 ? Json(nullptr) : Json(rig.parents[j])},
                    {"position", to_json(rig.joints.row(j))}});
  }
  return list;
}

/// Joints that move no vertex, vertices without a joint, and how many joints vertices have.
Json checks_of(const Rig& rig) {
  std::vector<Eigen::Index> vertices_with(5, 0);
  std::vector<char> moves(static_cast<std::size_t>(rig.joints.rows()), 0);
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    std::size_t joints = 0;
    for (SkinWeights::InnerIterator it(rig.weights, v); it; ++it) {
      if (it.value() <= 0) continue;
      ++joints;
      moves[static_cast<std::size_t>(it.col())] = 1;
    }
    ++vertices_with[std::min(joints, vertices_with.size() - 1)];
  }
  return {{"vertices", rig.weights.rows()},
          {"vertices_without_joint", vertices_with[0]},
          {"vertices_with_1_2_3_4_joints",
           {vertices_with[1], vertices_with[2], vertices_with[3], vertices_with[4]}},
          {"joints_that_move_nothing", std::count(moves.begin(), moves.end(), 0)}};
}

}  // namespace

std::string rig_report_json(const RigRecord& record) {
  const BodyPlan& plan = record.plan;
  const Json json = {{"program", program_and_version()},
                     {"file", record.file},
                     {"plan", name_of(body_kinds, plan.plan)},
                     {"plan_reason", plan.reason},
                     {"left", to_json(plan.axes.row(0))},
                     {"up", to_json(plan.axes.row(1))},
                     {"front", to_json(plan.axes.row(2))},
                     {"roles", roles_of(record)},
                     {"missing_roles", plan.missing},
                     {"parts", parts_of(record.parts)},
                     {"joints", joints_of(record.rig)},
                     {"checks", checks_of(record.rig)},
                     {"seconds", record.seconds}};
  return json.dump(2) + "\n";
}

}  // namespace curveskel
