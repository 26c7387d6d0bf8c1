// Laws of the bones that a limb is cut into: as by trying all places.
#include "rig/joints/limb_bones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel::limb_bones_laws {
namespace {

using Samples = std::vector<LimbSample>;

struct Curve {
  int nodes;
  double bend;      // radians, from each segment to the next
  double thickest;  // of the nodes; the thinnest are 0
};

/// Some nodes have no sample, as where they lie close together.
Samples random_limb(const Curve& curve, const BoneCost& cost, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
  double radius = curve.thickest * unit(random);
  Samples samples{{at, radius, 0, 0, true}};
  double way = 0;
  for (int node = 1; node < curve.nodes; ++node) {
    ahead += curve.bend * Eigen::Vector3d(unit(random) - 0.5, unit(random) - 0.5, 0);
    ahead.normalize();
    const Eigen::Vector3d next = at + ahead * (0.5 + unit(random));
    const double next_radius = curve.thickest * unit(random);
    const int pieces = 1 + static_cast<int>(9 * unit(random));
    for (int piece = 1; piece <= pieces; ++piece) {
      const double share = static_cast<double>(piece) / pieces;
      const double here = radius + share * (next_radius - radius);
      way += (next - at).norm() / pieces / std::max(here, cost.least_radius);
      const bool is_last = node + 1 == curve.nodes && piece == pieces;
      if (unit(random) < 0.2 && !is_last) continue;
      const bool is_at_node = piece == pieces;
      samples.push_back(
          {at + share * (next - at), here, way, idx(is_at_node ? node : node - 1), is_at_node});
    }
    at = next;
    radius = next_radius;
  }
  return samples;
}

double cost_of(const Samples& samples, std::size_t i, std::size_t j, const BoneCost& cost) {
  const double length = (samples[j].way - samples[i].way) / cost.bone_length;
  const Eigen::Vector3d from = samples[i].point;
  const Eigen::Vector3d bone = samples[j].point - from;
  double deviation = 0;
  for (std::size_t k = i + 1; k < j; ++k) {
    const Eigen::Vector3d arm = samples[k].point - from;
    const double share = std::clamp(arm.dot(bone) / bone.squaredNorm(), 0.0, 1.0);
    const double radius = std::max(samples[k].radius, cost.least_radius);
    deviation = std::max(deviation, (arm - share * bone).norm() / radius / cost.bend);
  }
  return 1 + length * length + deviation * deviation;
}

/// The least cost of all ways to cut.
double least_cost(const Samples& samples, const BoneCost& cost) {
  std::vector<double> sum(samples.size(), std::numeric_limits<double>::infinity());
  sum[0] = 0;
  for (std::size_t j = 1; j < samples.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const bool is_whole = i == 0 && j + 1 == samples.size();
      const double chord = (samples[j].point - samples[i].point).norm();
      if (!is_whole && chord < cost.least_length) continue;
      sum[j] = std::min(sum[j], sum[i] + cost_of(samples, i, j, cost));
    }
  }
  return sum.back();
}

TEST(LimbBones, CostLeastOfAll) {
  std::mt19937 random(11);
  for (const int nodes : {2, 3, 8, 30}) {
    for (const double bend : {0.0, 0.3, 2.0}) {
      for (const double thickest : {0.05, 0.5, 3.0}) {
        SCOPED_TRACE(testing::Message() << nodes << " nodes, bend " << bend << ", " << thickest);
        const BoneCost cost{6, 0.5, 0.2, 0.3};
        const Samples samples = random_limb({nodes, bend, thickest}, cost, random);
        const std::vector<std::size_t> joints = best_joints(samples, 0, samples.size() - 1, cost);
        ASSERT_EQ(joints.front(), 0U);
        ASSERT_EQ(joints.back(), samples.size() - 1);
        double all = 0;
        for (std::size_t k = 1; k < joints.size(); ++k) {
          all += cost_of(samples, joints[k - 1], joints[k], cost);
        }
        EXPECT_NEAR(all, least_cost(samples, cost), 1e-9 * all);
      }
    }
  }
}

TEST(LimbBones, OfOnePlaceIsOneJoint) {
  const Samples samples{{Eigen::Vector3d::Zero(), 1, 0, 0, true},
                        {Eigen::Vector3d::UnitX(), 1, 1, 1, true}};
  EXPECT_EQ(best_joints(samples, 1, 1, {6, 0.5, 0.2, 0.3}), std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace curveskel::limb_bones_laws
