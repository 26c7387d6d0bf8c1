#include <curveskel/rest_pose.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "rig/joints/end_names.hpp"
#include "rig/joints/figure_name.hpp"
#include "rig/joints/keep_joints.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/measure/rig_bones.hpp"

namespace curveskel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

int joint_of(const Rig& rig, const std::string& role) {
  const auto found = std::find(rig.roles.begin(), rig.roles.end(), role);
  return found == rig.roles.end() ? -1 : static_cast<int>(found - rig.roles.begin());
}

/// Its first one, or -1.
int child_of(const Rig& rig, int joint) {
  const auto found = std::find(rig.parents.begin(), rig.parents.end(), joint);
  return joint < 0 || found == rig.parents.end() ? -1
                                                 : static_cast<int>(found - rig.parents.begin());
}

/// A bone that the pose points somewhere, by the joints at its ends.
struct PosedBone {
  std::string_view from;
  std::string_view to;
  bool is_arm;  ///< sideways; else down
};

/// Each after the one above it. A hand points to the root of a finger, or to what there is.
constexpr std::array posed_bones{
    PosedBone{"UpperArm", "LowerArm", true}, PosedBone{"LowerArm", "Hand", true},
    PosedBone{"Hand", "MiddleProximal", true}, PosedBone{"UpperLeg", "LowerLeg", false},
    PosedBone{"LowerLeg", "Foot", false}};

}  // namespace

namespace {

/// By joint, beyond the turn of what is above.
struct Turns {
  std::vector<Quaterniond> more;
  std::vector<char> stays;  // as in the file
};

/// Of one figure of the rig, a human.
void add_t_pose(const Rig& rig, const BodyPlan& plan, const std::string& figure, Turns& turns) {
  for (const std::string side : {"left", "right"}) {
    const Vector3d out = (side == "left" ? 1 : -1) * plan.axes.row(0).transpose();
    const Vector3d down = -plan.axes.row(1).transpose();
    Quaterniond arm = Quaterniond::Identity();
    Quaterniond leg = Quaterniond::Identity();
    for (const PosedBone& bone : posed_bones) {
      const int from = joint_of(rig, figure + side + std::string(bone.from));
      const int named = joint_of(rig, figure + side + std::string(bone.to));
      const int to = named < 0 && bone.from == "Hand" ? child_of(rig, from) : named;
      if (from < 0 || to < 0) continue;
      Quaterniond& above = bone.is_arm ? arm : leg;
      const Vector3d way = (rig.joints.row(to) - rig.joints.row(from)).transpose();
      turns.more[idx(from)] = Quaterniond::FromTwoVectors(above * way, bone.is_arm ? out : down);
      above = turns.more[idx(from)] * above;
    }
    const int foot = joint_of(rig, figure + side + "Foot");
    if (foot >= 0) turns.stays[idx(foot)] = 1;
  }
}

}  // namespace

void rest_in_t_pose(Rig& rig, const BodyPlan& plan, const std::vector<BodyPlan>& other_plans) {
  require_sound(rig, "rest_in_t_pose");
  const auto count = static_cast<std::size_t>(rig.parents.size());
  Turns turns{std::vector<Quaterniond>(count, Quaterniond::Identity()),
              std::vector<char>(count, 0)};
  bool is_posed = false;
  for (std::size_t figure = 0; figure <= other_plans.size(); ++figure) {
    const BodyPlan& its = figure == 0 ? plan : other_plans[figure - 1];
    if (its.plan != BodyKind::humanoid) continue;
    add_t_pose(rig, its, figure_prefix(figure), turns);
    is_posed = true;
  }
  if (!is_posed) {
    throw Error(Fault::input, "the T pose is a human's, found the plan " +
                                  std::string(name_of(body_kinds, plan.plan)) +
                                  "; say --plan humanoid, or leave the pose as it is");
  }
  rig.turns.assign(count, Quaterniond::Identity());
  for (std::size_t joint = 0; joint < count; ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (turns.stays[joint] != 0) continue;
    rig.turns[joint] =
        (turns.more[joint] * (parent < 0 ? Quaterniond::Identity() : rig.turns[idx(parent)]))
            .normalized();
  }
}

Rig with_ground_root(const Rig& rig, const Surface& surface, const Eigen::RowVector3d& up) {
  require_sound(rig, "with_ground_root");
  if (rig.joints.rows() == 0 || surface.positions.rows() == 0) {
    throw Error(Fault::input, "with_ground_root: found " + std::to_string(rig.joints.rows()) +
                                  " joints and " + std::to_string(surface.positions.rows()) +
                                  " vertices, needed at least one of each");
  }
  Rig result;
  result.to_y_up = rig.to_y_up;
  const Eigen::Index count = rig.joints.rows();
  const double ground = (surface.positions * up.transpose()).minCoeff();
  const auto roots = std::find(rig.parents.begin(), rig.parents.end(), -1);
  const Eigen::RowVector3d first = rig.joints.row(roots - rig.parents.begin());
  result.joints.resize(count + 1, 3);
  result.joints << first + (ground - first.dot(up)) * up, rig.joints;
  result.parents.resize(count + 1);
  result.parents << -1, rig.parents.array() + 1;
  const auto before = [](const auto& list, const auto& item) {
    std::remove_cvref_t<decltype(list)> longer;
    if (list.empty()) return longer;
    longer.reserve(list.size() + 1);
    longer.push_back(item);
    longer.insert(longer.end(), list.begin(), list.end());
    return longer;
  };
  const bool taken = std::find(rig.names.begin(), rig.names.end(), "root") != rig.names.end();
  result.names = before(rig.names, std::string(taken ? "ground_root" : "root"));
  result.readable = before(rig.readable, std::string(taken ? "ground_root" : "root"));
  result.roles = before(rig.roles, std::string());
  result.turns = before(rig.turns, Quaterniond::Identity());
  std::vector<Eigen::Triplet<float>> entries;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      entries.emplace_back(static_cast<int>(vertex), static_cast<int>(it.col()) + 1, it.value());
    }
  }
  result.weights.resize(rig.weights.rows(), count + 1);
  result.weights.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Rig with_one_root(const Rig& rig, const Surface& surface, const Eigen::RowVector3d& up) {
  const bool has_several = (rig.parents.array() < 0).count() > 1;
  return has_several ? with_ground_root(rig, surface, up) : rig;
}

Rig without_ends(const Rig& rig) {
  require_sound(rig, "without_ends");
  const Eigen::Index count = rig.joints.rows();
  const std::vector<bool> moves = moving_joints(rig);
  std::vector<char> stays(moves.begin(), moves.end());
  for (Eigen::Index joint = 0; joint < count; ++joint) {
    if (!is_end_name(rig.names[idx(joint)]) || rig.parents[joint] < 0) stays[idx(joint)] = 1;
  }
  mark_ancestors(rig, stays);
  return keep_joints(rig, numbers_of(stays));
}

Rig rig_for_export(Rig rig, const BodyPlan& plan, const Surface& surface,
                   const ExportOptions& options, const std::vector<BodyPlan>& other_plans) {
  OptionCheck("ExportOptions").choice("pose", options.pose, rest_poses);
  if (options.pose == RestPose::t && options.as_given) {
    throw Error(Fault::input,
                "the T pose is made by a plan of the body, which joints that are "
                "given have not; leave out --pose, or have the joints made");
  }
  if (options.pose == RestPose::t) rest_in_t_pose(rig, plan, other_plans);
  if (!options.ends) rig = without_ends(rig);
  const Eigen::RowVector3d up =
      plan.plan == BodyKind::none ? Eigen::RowVector3d(0, 1, 0) : plan.axes.row(1);
  if (options.ground_root) return with_ground_root(rig, surface, up);
  return options.as_given ? rig : with_one_root(rig, surface, up);
}

}  // namespace curveskel
