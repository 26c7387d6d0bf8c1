#include "surface/read/bound_joints.hpp"

#include <algorithm>
#include <cstddef>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {
namespace {

bool move_alike(const std::vector<BoundJoint>& joints) {
  if (joints.empty()) return true;
  constexpr double alike = 1e-4;
  Eigen::AlignedBox3d box;
  for (const BoundJoint& joint : joints) box.extend(joint.bound.translation().eval());
  const Eigen::Affine3d first = joints.front().move();
  const double scale = first.linear().norm();
  return std::ranges::none_of(joints, [&](const BoundJoint& joint) {
    const Eigen::Affine3d move = joint.move();
    const Eigen::Vector3d place = joint.bound.translation();
    return (move.linear() - first.linear()).norm() > alike * scale ||
           (move * place - first * place).norm() > alike * scale * box.diagonal().norm();
  });
}

struct BoundFigure {
  const BoundJoint* topmost = nullptr;
  std::vector<BoundJoint> moving;

  void add(const BoundJoint& joint) {
    const bool is_higher = topmost == nullptr || joint.nodes_above < topmost->nodes_above;
    if (is_higher) topmost = &joint;
    if (joint.moves_vertices) moving.push_back(joint);
  }
};

}  // namespace

void BoundJoints::add(SceneNode node, const BoundJoint& joint) {
  const auto [entry, is_new] = number_of_.try_emplace(node, static_cast<int>(joints_.size()));
  if (is_new) {
    joints_.push_back(joint);
    told_.emplace_back();
  }
  joints_[idx(entry->second)].moves_vertices |= joint.moves_vertices;
  told_[idx(entry->second)].push_back(joint.bound);
  box_.extend(joint.bound.translation().eval());
}

void BoundJoints::join(SceneNode node, SceneNode kin) {
  const int joint = number_of_.at(node);
  pairs_.emplace_back(joint, first_with_.try_emplace(kin, joint).first->second);
}

std::unordered_map<SceneNode, MovedJoint> BoundJoints::bent_figures() const {
  std::unordered_map<SceneNode, MovedJoint> bent;
  const auto is_clear = [&](const auto& frames) { return are_alike(frames, size()); };
  if (!std::ranges::all_of(told_, is_clear)) return bent;
  UnionFind figures(static_cast<std::int64_t>(joints_.size()));
  for (const auto& [a, b] : pairs_) figures.unite(a, b);
  const std::vector<int> figure_of = figures.numbers();
  std::vector<BoundFigure> all(joints_.size());
  for (std::size_t k = 0; k < joints_.size(); ++k) all[idx(figure_of[k])].add(joints_[k]);
  for (const auto& [node, number] : number_of_) {
    const BoundFigure& figure = all[idx(figure_of[idx(number)])];
    if (move_alike(figure.moving)) continue;
    bent.emplace(node, MovedJoint{joints_[idx(number)].bound, figure.topmost->move()});
  }
  return bent;
}

bool are_alike(const std::vector<Eigen::Affine3d>& frames, double size) {
  constexpr double alike = 1e-3;
  return std::all_of(frames.begin(), frames.end(), [&](const Eigen::Affine3d& frame) {
    const Eigen::Affine3d& first = frames.front();
    return (frame.linear() - first.linear()).norm() <= alike * first.linear().norm() &&
           (frame.translation() - first.translation()).norm() <= alike * size;
  });
}

bool is_invertible(const Eigen::Affine3d& frame) {
  return frame.linear().determinant() != 0 && frame.inverse().matrix().allFinite();
}

}  // namespace curveskel
