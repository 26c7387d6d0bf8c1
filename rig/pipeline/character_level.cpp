#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/rig_character.hpp>
#include "rig/joints/keep_joints.hpp"

namespace curveskel {
namespace {

double distance_to_edge(const CurveSkeleton& skeleton, Eigen::Index edge,
                        const Eigen::RowVector3d& place) {
  const Eigen::RowVector3d from = skeleton.nodes.row(skeleton.edges(edge, 0));
  const Eigen::RowVector3d way = skeleton.nodes.row(skeleton.edges(edge, 1)) - from;
  const double squared = way.squaredNorm();
  const double share = squared > 0 ? std::clamp((place - from).dot(way) / squared, 0.0, 1.0) : 0;
  return (from + share * way - place).norm();
}

/// Of the nearest edge; where branches meet, that of the longest life.
double life_at(const CurveSkeleton& skeleton, const Eigen::VectorXd& lives,
               const Eigen::RowVector3d& place, double near) {
  Eigen::VectorXd distances(skeleton.edges.rows());
  for (Eigen::Index edge = 0; edge < distances.size(); ++edge) {
    distances[edge] = distance_to_edge(skeleton, edge, place);
  }
  const double least = distances.minCoeff();
  double life = 0;
  for (Eigen::Index edge = 0; edge < distances.size(); ++edge) {
    if (distances[edge] <= least + near) life = std::max(life, lives[edge]);
  }
  return life;
}

/// Without these there is no body: what VRM requires of a human, the trunk and head of others.
bool is_required(const CharacterRig& character, std::size_t joint) {
  if (joint >= character.rig.roles.size()) return false;
  const std::string& role = character.rig.roles[joint];
  if (character.plan.plan == BodyKind::humanoid) {
    return std::find(required_human_roles.begin(), required_human_roles.end(), role) !=
           required_human_roles.end();
  }
  const std::array<std::string_view, 3> trunk{"spine", "neck", "head"};
  return std::any_of(trunk.begin(), trunk.end(),
                     [&](std::string_view word) { return role.starts_with(word); });
}

/// The planned joints are the first of the rig.
void keep_planned(BodyPlan& plan, const std::vector<int>& number) {
  std::vector<PlannedJoint> kept;
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    if (number[k] < 0) continue;
    kept.push_back(std::move(plan.joints[k]));
    int& parent = kept.back().parent;
    if (parent >= 0) parent = number[idx(parent)];
  }
  plan.joints = std::move(kept);
}

}  // namespace

CharacterRig level_of_character(CharacterRig character, const CurveSkeleton& skeleton,
                                double least_life) {
  const Rig& rig = character.rig;
  if (skeleton.lives.size() == 0 || skeleton.edges.rows() == 0 || !(least_life > 0)) {
    return character;
  }
  const Eigen::VectorXd lives = edge_lives(skeleton);
  const double near =
      1e-6 * (skeleton.nodes.colwise().maxCoeff() - skeleton.nodes.colwise().minCoeff()).norm();
  std::vector<char> stays(rig.names.size(), 0);
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    const int parent = rig.parents[row];
    const bool hangs = parent < 0 || stays[idx(parent)] != 0;
    const bool lives_on =
        parent < 0 || life_at(skeleton, lives, rig.joints.row(row), near) >= least_life;
    stays[joint] = (hangs && lives_on) || is_required(character, joint) ? 1 : 0;
  }
  const std::vector<int> number = numbers_of_kept(rig, stays);
  character.rig = keep_joints(rig, number);
  keep_planned(character.plan, number);
  return character;
}

}  // namespace curveskel
