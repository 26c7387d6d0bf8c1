#include "app/rig_report.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/check_weights.hpp>
#include "app/report.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::RowVector3d& point) { return {point.x(), point.y(), point.z()}; }

struct NumberedRecord {
  explicit NumberedRecord(const RigRecord& given) : record(given) {
    for (const std::string& name : given.written.names) number_of.emplace(name, number_of.size());
  }

  const RigRecord& record;
  std::map<std::string, std::size_t> number_of;  ///< of the written joints, by their names
};

/// `first` is the character's joint that is the plan's first.
Json roles_of(const BodyPlan& plan, const NumberedRecord& numbered, std::size_t first) {
  const RigRecord& record = numbered.record;
  Json roles = Json::object();
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    const PlannedJoint& joint = plan.joints[k];
    const std::string& name = record.character.rig.names[first + k];
    const auto number = numbered.number_of.find(name);
    if (number == numbered.number_of.end()) continue;
    const auto row = static_cast<Eigen::Index>(number->second);
    roles[joint.role] = {{"joint", name},
                         {"number", row},
                         {"position", to_json(record.written.joints.row(row))},
                         {"reason", joint.reason}};
  }
  return roles;
}

/// Of joints that were given or kept, which have no plan.
Json roles_of(const Rig& given) {
  Json roles = Json::object();
  for (std::size_t joint = 0; joint < given.roles.size(); ++joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    if (given.roles[joint].empty()) continue;
    roles[given.roles[joint]] = {{"joint", given.names[joint]},
                                 {"number", row},
                                 {"position", to_json(given.joints.row(row))},
                                 {"reason", "given with the joint, or said by its name"}};
  }
  return roles;
}

Json plan_of(const BodyPlan& plan, const NumberedRecord& numbered, std::size_t first) {
  return {{"plan", name_of(body_kinds, plan.plan)}, {"plan_reason", plan.reason},
          {"left", to_json(plan.axes.row(0))},      {"up", to_json(plan.axes.row(1))},
          {"front", to_json(plan.axes.row(2))},     {"roles", roles_of(plan, numbered, first)},
          {"missing_roles", plan.missing}};
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

Json other_figures_of(const NumberedRecord& numbered) {
  const CharacterRig& character = numbered.record.character;
  Json list = Json::array();
  for (std::size_t k = 0; k < character.other_plans.size(); ++k) {
    const BodyPlan& plan = character.other_plans[k];
    const std::string prefix = "figure" + std::to_string(k + 2) + "_";
    const std::vector<std::string>& names = character.rig.names;
    const auto first = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return name.starts_with(prefix);
    });
    Json figure = {{"names_begin_with", prefix}};
    figure.update(plan_of(plan, numbered, static_cast<std::size_t>(first - names.begin())));
    list.push_back(std::move(figure));
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

Json checks_of(const NumberedRecord& numbered) {
  const RigRecord& record = numbered.record;
  const WeightChecks checks =
      check_weights(record.given, record.character.rig, record.character.follows);
  const auto name_of_joint = [&](int joint) {
    return record.character.rig.names[static_cast<std::size_t>(joint)];
  };
  Json idle = Json::array();
  for (const int joint : checks.idle) {
    if (numbered.number_of.contains(name_of_joint(joint))) idle.push_back(name_of_joint(joint));
  }
  Json islands = Json::array();
  for (const auto& island : checks.islands) {
    islands.push_back({{"joint", name_of_joint(island.joint)},
                       {"vertices", island.vertices},
                       {"follower", island.follows}});
  }
  Json poses = Json::array();
  for (const auto& pose : checks.poses) {
    poses.push_back(
        {{"joint", name_of_joint(pose.joint)}, {"stretch", pose.stretch}, {"volume", pose.volume}});
  }
  return {{"vertices", checks.vertices},
          {"vertices_without_joint", checks.unweighted},
          {"vertices_with_1_2_3_4_joints", checks.with_influences},
          {"joints_that_move_nothing", std::move(idle)},
          {"islands", std::move(islands)},
          {"bleeding_vertices", checks.bleeding},
          {"poses", std::move(poses)}};
}

}  // namespace

std::string rig_report_json(const RigRecord& record) {
  const NumberedRecord numbered(record);
  Json json = {{"program", program_and_version()}, {"file", record.file}};
  json.update(plan_of(record.character.plan, numbered, 0));
  if (record.character.plan.joints.empty()) json["roles"] = roles_of(record.written);
  json.update({{"other_figures", other_figures_of(numbered)},
               {"parts", parts_of(record.character.parts)},
               {"joints_left_out", record.character.joints_left_out},
               {"joints_over_budget", record.character.joints_over_budget},
               {"joints", joints_of(record.written)},
               {"checks", checks_of(numbered)},
               {"seconds", record.seconds}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace curveskel
