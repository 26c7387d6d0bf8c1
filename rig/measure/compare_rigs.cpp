#include <curveskel/compare_rigs.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/error.hpp>
#include "base/least_pairs.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/measure/limb_poses.hpp"
#include "rig/measure/rig_bones.hpp"

namespace curveskel {
namespace {

constexpr double hit_share = 0.05;      // of L
constexpr double sample_share = 0.005;  // of L, along bones

double longest_box_side(const Surface& surface) {
  if (surface.positions.rows() > 0) {
    const double side =
        (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff())
            .maxCoeff();
    if (std::isfinite(side) && side > 0) return side;
  }
  throw Error(Fault::input,
              "the truth's surface has no extent; needed is one to measure lengths by");
}

Eigen::MatrixXd distances_between(const Positions& rows, const Positions& others) {
  Eigen::MatrixXd distances(rows.rows(), others.rows());
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    distances.row(row) = (others.rowwise() - rows.row(row)).rowwise().norm().transpose();
  }
  return distances;
}

/// Half as thick as the surface is round each of these joints: the mean way to it across their
/// bones, in 14 directions of each; `otherwise` where no way meets it.
Eigen::VectorXd half_thickness(const Surface& surface, const RigBones& bones, double otherwise) {
  constexpr int directions = 14;
  const SurfaceTree tree(surface);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(bones.places.rows());
  Eigen::VectorXd counts = sums;
  for (const auto& [parent, child] : bones.ends) {
    const Eigen::Vector3d along =
        (bones.places.row(child) - bones.places.row(parent)).transpose().normalized();
    const Eigen::Vector3d one = along.unitOrthogonal();
    const Eigen::Vector3d two = along.cross(one);
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      const Eigen::Vector3d across = std::cos(angle) * one + std::sin(angle) * two;
      for (const int joint : {parent, child}) {
        const auto hit = tree.ray(bones.places.row(joint).transpose(), across);
        if (hit.triangle < 0) continue;
        sums[joint] += hit.distance;
        counts[joint] += 1;
      }
    }
  }
  return (counts.array() > 0).select(sums.array() / counts.array().max(1), otherwise);
}

JointHits joint_hits(const Eigen::MatrixXd& distances, const std::vector<int>& pairs,
                     const Eigen::VectorXd& tolerances) {
  JointHits result;
  for (std::size_t truth = 0; truth < pairs.size(); ++truth) {
    const auto row = static_cast<Eigen::Index>(truth);
    if (pairs[truth] >= 0 && distances(row, pairs[truth]) < tolerances[row]) ++result.hits;
  }
  const auto theirs = static_cast<double>(distances.rows());
  const auto ours = static_cast<double>(distances.cols());
  result.overlap = 2 * result.hits / (theirs + ours);
  result.precision = result.hits / ours;
  result.recall = result.hits / theirs;
  return result;
}

std::string why_not_posed(const RiggedSurface& rig, const RiggedSurface& truth, double size) {
  constexpr double alike = 1e-4;
  if (rig.rig.weights.rows() == 0) return "no weights are known of the rig";
  if (truth.rig.weights.rows() == 0) return "no weights are known of the truth";
  const auto ours = rig.surface.positions.rows();
  const auto theirs = truth.surface.positions.rows();
  if (ours != theirs) {
    return std::to_string(ours) + " vertices, the truth has " + std::to_string(theirs);
  }
  const double apart =
      (rig.surface.positions - truth.surface.positions).rowwise().norm().maxCoeff();
  if (apart <= alike * size) return "";
  return "the surfaces rest in different places or poses, or their vertices in another order";
}

/// The joint of the rig that is the same as each of the truth's; empty where those that move
/// something are not in the same places. Of several in one place the names tell.
std::vector<int> same_joints(const Rig& rig, const Rig& truth, double size,
                             const std::stop_token& stop) {
  constexpr double alike = 1e-3;
  Eigen::MatrixXd costs = distances_between(truth.joints, rig.joints) / size;
  for (Eigen::Index row = 0; row < costs.rows(); ++row) {
    for (Eigen::Index column = 0; column < costs.cols(); ++column) {
      const bool same_name = truth.names[idx(row)] == rig.names[idx(column)];
      costs(row, column) += same_name ? 0 : 0.1 * alike;
    }
  }
  const std::vector<int> pairs = least_pairs(costs, stop);
  std::vector<bool> ours = moving_joints(rig);
  const std::vector<bool> theirs = moving_joints(truth);
  for (std::size_t joint = 0; joint < pairs.size(); ++joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    const bool same = pairs[joint] >= 0 && costs(row, pairs[joint]) <= 1.1 * alike;
    if (same) ours[idx(pairs[joint])] = false;
    if (!same && theirs[joint]) return {};
  }
  const bool others = std::find(ours.begin(), ours.end(), true) != ours.end();
  return others ? std::vector<int>{} : pairs;
}

/// `pairs`: the rig's joint of each of the truth's, or -1.
WeightDifference compare_weights(const SkinWeights& rig, const SkinWeights& truth,
                                 const std::vector<int>& pairs) {
  constexpr float least = 1e-4F;
  WeightDifference result;
  double ours = 0;
  double theirs = 0;
  double both = 0;
  double vertices = 0;
  Eigen::VectorXf row = Eigen::VectorXf::Zero(rig.cols());
  for (Eigen::Index vertex = 0; vertex < truth.rows(); ++vertex) {
    if (!(truth.row(vertex).sum() > 0)) continue;  // nothing is said of it
    for (SkinWeights::InnerIterator it(rig, vertex); it; ++it) {
      row[it.col()] = it.value();
      ours += it.value() > least ? 1 : 0;
    }
    for (SkinWeights::InnerIterator it(truth, vertex); it; ++it) {
      const int same = pairs[idx(it.col())];
      const float our = same < 0 ? 0 : row[same];
      theirs += it.value() > least ? 1 : 0;
      both += it.value() > least && our > least ? 1 : 0;
      result.l1 += static_cast<double>(std::abs(it.value() - our));
      if (same >= 0) row[same] = 0;
    }
    result.l1 += static_cast<double>(row.sum());  // of joints that the truth's row has not
    for (SkinWeights::InnerIterator it(rig, vertex); it; ++it) row[it.col()] = 0;
    vertices += 1;
  }
  result.precision = ours > 0 ? both / ours : 0;
  result.recall = theirs > 0 ? both / theirs : 0;
  result.l1 = vertices > 0 ? result.l1 / vertices : 0;
  return result;
}

void compare_places(const Rig& rig, const RiggedSurface& truth, double size,
                    const std::stop_token& stop, RigComparison& result) {
  constexpr double one_place = 1e-6;
  const RigBones ours = rig_bones(rig, one_place * size);
  const RigBones theirs = rig_bones(truth.rig, one_place * size);
  const Positions our_samples = samples_of(ours, sample_share * size);
  const Positions their_samples = samples_of(theirs, sample_share * size);
  const auto both_ways = [size](const Positions& a, const Positions& near_a, const Positions& b,
                                const Positions& near_b) {
    return (mean_nearest(a, near_a) + mean_nearest(b, near_b)) / 2 / size;
  };
  result.joints = static_cast<int>(ours.places.rows());
  result.truth_joints = static_cast<int>(theirs.places.rows());
  result.joints_to_joints = both_ways(ours.places, theirs.places, theirs.places, ours.places);
  result.joints_to_bones = both_ways(ours.places, their_samples, theirs.places, our_samples);
  result.bones_to_bones = both_ways(our_samples, their_samples, their_samples, our_samples);
  result.root_distance =
      (rig.joints.row(root_joint(rig)) - truth.rig.joints.row(root_joint(truth.rig))).norm() / size;
  const Eigen::MatrixXd distances = distances_between(theirs.places, ours.places);
  const std::vector<int> pairs = least_pairs(distances, stop);
  const double fixed = hit_share * size;
  result.by_size = joint_hits(distances, pairs, Eigen::VectorXd::Constant(distances.rows(), fixed));
  result.by_thickness = joint_hits(distances, pairs, half_thickness(truth.surface, theirs, fixed));
}

void require_comparable(const RiggedSurface& one) {
  require_corners(one.surface, "compare_rigs");
  require_sound(one.rig, "compare_rigs");
  if (one.rig.joints.rows() == 0) {
    throw Error(Fault::input, "compare_rigs: found a rig without joints, needed at least one");
  }
  if (one.rig.weights.rows() == 0) return;
  require_weights_of(one.rig, one.surface.positions.rows(), "compare_rigs");
}

}  // namespace

RigComparison compare_rigs(const RiggedSurface& rig, const RiggedSurface& truth,
                           const Monitor& monitor) {
  require_comparable(rig);
  require_comparable(truth);
  monitor.report("compare", 0);
  const double size = longest_box_side(truth.surface);
  RigComparison result;
  compare_places(rig.rig, truth, size, monitor.stop, result);
  monitor.report("compare", 0.5);
  result.not_posed = why_not_posed(rig, truth, size);
  result.not_weighed = result.not_posed;
  if (!result.not_posed.empty()) return result;
  result.poses = compare_poses(rig.rig, truth, size, monitor);
  const std::vector<int> pairs = same_joints(rig.rig, truth.rig, size, monitor.stop);
  if (pairs.empty()) {
    result.not_weighed = "the joints are in other places than the truth's";
  } else {
    result.weights = compare_weights(rig.rig.weights, truth.rig.weights, pairs);
  }
  return result;
}

}  // namespace curveskel
