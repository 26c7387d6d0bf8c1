#include "rig/measure/rig_bones.hpp"

#include <algorithm>
#include <cmath>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

std::vector<int> child_counts(const Rig& rig) {
  std::vector<int> counts(idx(rig.parents.size()), 0);
  for (const int parent : rig.parents) {
    if (parent >= 0) ++counts[idx(parent)];
  }
  return counts;
}

/// Of each joint: it has the greatest weight of some vertex.
std::vector<bool> leading_joints(const Rig& rig) {
  std::vector<bool> leads(idx(rig.parents.size()), false);
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    Eigen::Index most = -1;
    float weight = 0;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() <= weight) continue;
      most = it.col();
      weight = it.value();
    }
    if (most >= 0) leads[idx(most)] = true;
  }
  return leads;
}

/// Parents come before their children. None where nothing is known of the weights.
std::vector<bool> handles_of(const Rig& rig) {
  if (rig.weights.rows() == 0) return std::vector<bool>(idx(rig.parents.size()), false);
  const std::vector<int> children = child_counts(rig);
  const std::vector<bool> leads = leading_joints(rig);
  std::vector<bool> handles(children.size(), false);
  for (std::size_t joint = 0; joint < children.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    handles[joint] = (parent < 0 || handles[idx(parent)]) && !leads[joint] && children[joint] == 1;
  }
  return handles;
}

}  // namespace

std::vector<bool> moving_joints(const Rig& rig) {
  std::vector<bool> moves(idx(rig.parents.size()), false);
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() > 0) moves[idx(it.col())] = true;
    }
  }
  return moves;
}

RigBones rig_bones(const Rig& rig, double tolerance) {
  const std::vector<bool> handles = handles_of(rig);
  std::vector<int> number(handles.size(), -1);
  RigBones bones;
  bones.places.resize(rig.joints.rows(), 3);
  int count = 0;
  for (std::size_t joint = 0; joint < handles.size(); ++joint) {
    if (handles[joint]) continue;
    const auto row = static_cast<Eigen::Index>(joint);
    for (int known = 0; known < count && number[joint] < 0; ++known) {
      const double apart = (bones.places.row(known) - rig.joints.row(row)).norm();
      if (apart <= tolerance) number[joint] = known;
    }
    if (number[joint] < 0) {
      bones.places.row(count) = rig.joints.row(row);
      number[joint] = count++;
    }
    const int parent = rig.parents[row];
    const int above = parent < 0 ? -1 : number[idx(parent)];
    if (above >= 0 && above != number[joint]) bones.ends.emplace_back(above, number[joint]);
  }
  bones.places.conservativeResize(count, 3);
  return bones;
}

int root_joint(const Rig& rig) {
  const std::vector<bool> handles = handles_of(rig);
  std::vector<int> below(handles.size(), 1);
  int top = -1;
  for (std::size_t joint = handles.size(); joint-- > 0;) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (parent >= 0) below[idx(parent)] += below[joint];
    const bool is_top = !handles[joint] && (parent < 0 || handles[idx(parent)]);
    if (is_top && (top < 0 || below[joint] >= below[idx(top)])) top = static_cast<int>(joint);
  }
  return top;
}

Positions samples_of(const RigBones& bones, double step) {
  if (bones.ends.empty()) return bones.places;
  std::vector<Eigen::RowVector3d> samples;
  for (const auto& [parent, child] : bones.ends) {
    const Eigen::RowVector3d from = bones.places.row(parent);
    const Eigen::RowVector3d way = bones.places.row(child) - from;
    const auto pieces = std::max<int>(1, static_cast<int>(std::lround(way.norm() / step)) - 1);
    for (int k = 0; k <= pieces; ++k) samples.emplace_back(from + way * k / pieces);
  }
  Positions rows(static_cast<Eigen::Index>(samples.size()), 3);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    rows.row(static_cast<Eigen::Index>(k)) = samples[k];
  }
  return rows;
}

double mean_nearest(const Positions& places, const Positions& others) {
  double sum = 0;
  for (const auto& place : places.rowwise()) {
    sum += std::sqrt((others.rowwise() - place).rowwise().squaredNorm().minCoeff());
  }
  return sum / static_cast<double>(places.rows());
}

}  // namespace curveskel
