// Laws of skin weights: shares of one, those of a tube along it, none of what only lies near.
#include <curveskel/advanced/skin_weights.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/topology.hpp>
#include "rig/skin/skin_sources.hpp"
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::skin_weights_laws {
namespace {

void expect_shares(const SkinWeights& weights, int most_joints) {
  for (Eigen::Index vertex = 0; vertex < weights.rows(); ++vertex) {
    double sum = 0;
    int joints = 0;
    for (SkinWeights::InnerIterator it(weights, vertex); it; ++it) {
      EXPECT_GT(it.value(), 0);
      EXPECT_LE(it.value(), 1);
      sum += static_cast<double>(it.value());
      ++joints;
    }
    EXPECT_NEAR(sum, 1, 1e-6) << vertex;
    EXPECT_LE(joints, most_joints) << vertex;
  }
}

TEST(SkinWeights, AreSharesOfAFewJointsInEveryVertex) {
  for (const RigSubject& subject : rig_subjects()) {
    for (const int most : {1, 2, 4}) {
      SCOPED_TRACE(subject.name + ", joints at most " + std::to_string(most));
      const Rig rig = make_rig(subject.surface, subject.skeleton,
                               {{.bone_length = 2}, {.softness = 2, .most_joints = most}}, {});
      ASSERT_EQ(rig.weights.rows(), subject.surface.positions.rows());
      ASSERT_EQ(rig.weights.cols(), rig.joints.rows());
      expect_shares(rig.weights, most);
    }
  }
}

/// Where so many have a share that each of them is small, the largest ones move the vertex.
TEST(SkinWeights, AreSharesHoweverShortTheBonesAndSoftTheSkin) {
  for (const RigSubject& subject : rig_subjects()) {
    for (const double softness : {0.05, 20.0}) {
      for (const double least : {0.0, 0.01, 0.1}) {
        SCOPED_TRACE(subject.name + ", softness " + std::to_string(softness));
        const Rig rig =
            make_rig(subject.surface, subject.skeleton,
                     {{.bone_length = 0.5}, {.softness = softness, .least_weight = least}}, {});
        expect_shares(rig.weights, 4);
        for (Eigen::Index k = 0; k < rig.weights.nonZeros(); ++k) {
          EXPECT_GE(rig.weights.valuePtr()[k], least * (1 - 1e-6));
        }
      }
    }
  }
}

/// Fewer joints are the largest of more.
TEST(SkinWeights, KeepTheLargestShares) {
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const JointOptions bones{.bone_length = 2};
    const SkinWeights four = make_rig(subject.surface, subject.skeleton, {bones, {}}, {}).weights;
    const SkinWeights one =
        make_rig(subject.surface, subject.skeleton, {bones, {.most_joints = 1}}, {}).weights;
    for (Eigen::Index vertex = 0; vertex < four.rows(); ++vertex) {
      float largest = 0;
      for (SkinWeights::InnerIterator it(four, vertex); it; ++it) {
        largest = std::max(largest, it.value());
      }
      const SkinWeights::InnerIterator kept(one, vertex);
      EXPECT_EQ(kept.value(), 1);
      EXPECT_GE(four.coeff(vertex, kept.col()), largest * (1 - 1e-6F)) << vertex;
    }
  }
}

bool same_bytes(const SkinWeights& a, const SkinWeights& b) {
  const auto same = [](const auto* x, const auto* y, Eigen::Index count) {
    return std::memcmp(x, y, idx(count) * sizeof *x) == 0;
  };
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         same(a.outerIndexPtr(), b.outerIndexPtr(), a.rows() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros()) &&
         same(a.valuePtr(), b.valuePtr(), a.nonZeros());
}

/// One component that is solved by all threads, and several that share them.
TEST(SkinWeights, AreTheSameOnAnyNumberOfThreads) {
  const shapes::Shape helix =
      shapes::subdivided(shapes::tube("", shapes::helix(3, 3, 2), shapes::constant(0.7), 18));
  ASSERT_GT(helix.surface.positions.rows(), 10000);
  std::vector<RigSubject> subjects{{"helix", helix.surface, helix.axis}};
  for (const RigSubject& subject : rig_subjects()) {
    if (subject.name == "three bodies") subjects.push_back(subject);
  }
  ASSERT_EQ(subjects.size(), 2U);
  for (const RigSubject& subject : subjects) {
    const auto rig_on = [&](int threads) {
      return make_rig(subject.surface, subject.skeleton,
                      {{.bone_length = 1.3}, {.threads = threads}}, {});
    };
    const Rig rig = rig_on(1);
    EXPECT_GT(rig.joints.rows(), 16) << subject.name;  // more than two blocks
    for (const int threads : {2, 5}) {
      EXPECT_TRUE(same_bytes(rig_on(threads).weights, rig.weights)) << subject.name << threads;
    }
  }
}

// ---- A straight tube: joints 0, 1, 2, ... along x ----------------------------------------------

struct RiggedTube {
  shapes::Shape shape;
  Rig rig;
};

RiggedTube rigged_tube(double softness) {
  shapes::Shape shape = shapes::tube("", shapes::straight(40), shapes::constant(1), 20);
  Rig rig = make_rig(shape.surface, shape.axis, {{.root = 0}, {.softness = softness}}, {});
  return {std::move(shape), std::move(rig)};
}

/// The mean weights of each ring of vertices, by its x.
std::map<double, Eigen::VectorXd> weights_along(const RiggedTube& tube) {
  std::map<double, Eigen::VectorXd> sums;
  std::map<double, int> counts;
  for (Eigen::Index vertex = 0; vertex < tube.rig.weights.rows(); ++vertex) {
    const double x = std::round(1e6 * tube.shape.surface.positions(vertex, 0)) / 1e6;
    Eigen::VectorXd& sum =
        sums.try_emplace(x, Eigen::VectorXd::Zero(tube.rig.joints.rows())).first->second;
    for (SkinWeights::InnerIterator it(tube.rig.weights, vertex); it; ++it) {
      sum[it.col()] += static_cast<double>(it.value());
    }
    ++counts[x];
  }
  for (auto& [x, sum] : sums) sum /= counts[x];
  return sums;
}

TEST(SkinWeights, GoFromJointToJointAlongATube) {
  for (const double softness : {0.3, 1.0, 3.0}) {
    SCOPED_TRACE(softness);
    const RiggedTube tube = rigged_tube(softness);
    ASSERT_GE(tube.rig.joints.rows(), 6);
    double before = -1e-3;
    for (const auto& [x, weights] : weights_along(tube)) {
      double mean = 0;
      for (Eigen::Index joint = 0; joint < weights.size(); ++joint) {
        mean += static_cast<double>(joint) * weights[joint];
      }
      EXPECT_GE(mean, before - 2e-3) << "x " << x;  // least_weight makes small steps
      before = mean;
    }
    EXPECT_NEAR(before, static_cast<double>(tube.rig.joints.rows()) - 2, 0.2);
  }
}

TEST(SkinWeights, GiveTheMiddleOfABoneToItsOwnJoint) {
  const RiggedTube tube = rigged_tube(1);
  const std::map<double, Eigen::VectorXd> along = weights_along(tube);
  for (Eigen::Index joint = 0; joint + 1 < tube.rig.joints.rows(); ++joint) {
    const double middle = 0.5 * (tube.rig.joints(joint, 0) + tube.rig.joints(joint + 1, 0));
    const Eigen::VectorXd& weights = along.lower_bound(middle)->second;
    EXPECT_GT(weights[joint], 0.8) << joint;
  }
}

/// At a joint the skin on both sides of it has a share in what both bones do.
TEST(SkinWeights, AreEvenAtAJoint) {
  const RiggedTube tube = rigged_tube(1);
  const std::map<double, Eigen::VectorXd> along = weights_along(tube);
  for (Eigen::Index joint = 1; joint + 1 < tube.rig.joints.rows(); ++joint) {
    const Eigen::VectorXd& weights = along.lower_bound(tube.rig.joints(joint, 0) - 1e-6)->second;
    EXPECT_NEAR(weights[joint], 0.5, 0.2) << joint;
    EXPECT_NEAR(weights[joint - 1], 0.5, 0.2) << joint;
  }
}

TEST(SkinWeights, GoOverMoreGentlyTheSofterTheyAre) {
  double before = 0;
  for (const double softness : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    double width = 0;  // the sum over rings of what is not the largest share
    for (const auto& [x, weights] : weights_along(rigged_tube(softness))) {
      width += 1 - weights.maxCoeff();
    }
    EXPECT_GT(width, 1.3 * before) << softness;
    before = width;
  }
}

// ---- What lies near, and what belongs ----------------------------------------------------------

/// Two arms of radius 1 along x, joined at x = 0.
TEST(SkinWeights, OfAnArmAreNotThoseOfTheArmBesideIt) {
  constexpr double length = 20;
  constexpr double between = 2.6;  // so that there is little room for the skin
  const std::vector<Eigen::RowVector3d> corners{
      {length, 0, 0}, {0, 0, 0}, {0, between, 0}, {length, between, 0}};
  const Surface u = shapes::tube_union("u", chain_through(corners, 1, 1e9), {0.1, 4}).surface;
  for (const bool is_extracted : {true, false}) {
    SCOPED_TRACE(is_extracted);
    const CurveSkeleton curve =
        is_extracted ? extract(u, {}, {}).skeleton : chain_through(corners, 1, 0.5);
    const Rig rig = make_rig(u, curve, {{}, {.softness = 2}}, {});
    int outer_shares = 0;
    for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
      if (u.positions(vertex, 0) < 0.6 * length) continue;
      const bool is_upper = u.positions(vertex, 1) > between / 2;
      for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
        if (rig.joints(it.col(), 0) < 0.1 * length) continue;
        ++outer_shares;
        EXPECT_EQ(rig.joints(it.col(), 1) > between / 2, is_upper) << vertex << ' ' << it.col();
      }
    }
    EXPECT_GT(outer_shares, 1000);
  }
}

TEST(SkinWeights, DoNotDependOnTheSizeOfTheSurface) {
  for (const RigSubject& subject : rig_subjects()) {
    const Rig rig = make_rig(subject.surface, subject.skeleton, {}, {});
    for (const double factor : {1e-3, 1e3}) {
      SCOPED_TRACE(subject.name + ", times " + std::to_string(factor));
      Surface surface = subject.surface;
      surface.positions *= factor;
      const Rig other = make_rig(surface, scaled_curve(subject.skeleton, factor), {}, {});
      ASSERT_EQ(other.weights.cols(), rig.weights.cols());
      EXPECT_LT(largest_difference(rig.weights, other.weights), 1e-5F);
    }
  }
}

std::string part_of(const std::string& joint) {
  return joint.starts_with("part") ? joint.substr(0, joint.find('_')) : "";
}

TEST(SkinWeights, OfOneComponentAreOfItsOwnJoints) {
  int several = 0;
  for (const RigSubject& subject : rig_subjects()) {
    SCOPED_TRACE(subject.name);
    const Topology parts = topology(subject.surface);
    if (parts.components() < 2) continue;
    ++several;
    const Rig rig = make_rig(subject.surface, subject.skeleton, {{}, {.softness = 4}}, {});
    std::vector<std::set<std::string>> movers(idx(parts.components()));
    for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
      for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
        movers[idx(parts.component_of_vertex[vertex])].insert(part_of(rig.names[idx(it.col())]));
      }
    }
    std::set<std::string> all;
    for (const auto& mover : movers) {
      EXPECT_EQ(mover.size(), 1U);
      all.insert(mover.begin(), mover.end());
    }
    EXPECT_EQ(all.size(), movers.size());
  }
  EXPECT_EQ(several, 2);
}

/// Legs side by side, a tenth of a radius apart: the bone of one is nearer to the inner skin of the
/// other than some of its own.
TEST(SkinWeights, OfALegAreNotOfTheLegBesideIt) {
  const double gap = 0.1;
  const shapes::Curve bow = [=](double t) -> Eigen::Vector3d {
    const double half = 1 + gap / 2;  // from the middle to an axis
    const double turn = std::numbers::pi * half;
    const double way = t * (20 + turn) - 10;  // along the axis from where the bow begins
    if (way < 0) return {-half, way, 0};
    if (way > turn) return {half, turn - way, 0};
    return {-half * std::cos(way / half), half * std::sin(way / half), 0};
  };
  const shapes::Shape legs = shapes::tube("", bow, shapes::constant(1), 24);
  const Rig rig = make_rig(legs.surface, legs.axis, {{.bone_length = 2}, {}}, {});
  int beside = 0;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    const Eigen::RowVector3d place = legs.surface.positions.row(vertex);
    if (place.y() > -5) continue;
    ++beside;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      EXPECT_GT(rig.joints(it.col(), 0) * place.x(), 0) << vertex;
    }
  }
  EXPECT_GT(beside, 100);
}

/// The nearer end of a bone tells, not the nearer joint.
TEST(SkinWeights, FollowTheBonesNotTheNodes) {
  const shapes::Shape bar =
      shapes::tube("", shapes::straight(10), shapes::constant(1), 16);  // x from -5 to 5
  CurveSkeleton axis = bar.axis;
  axis.node_of_vertex.setZero(bar.surface.positions.rows());
  const std::vector<Bone> bones{{0, {-5, 0, 0}, {0, 0, 0}}, {1, {0, 0, 0}, {5, 0, 0}}};
  const Eigen::VectorXi first = Eigen::VectorXi::Zero(axis.nodes.rows());
  const SkinWeights weights = skin_weights(bar.surface, axis, first, bones, 2);
  for (Eigen::Index vertex = 0; vertex < weights.rows(); ++vertex) {
    const double x = bar.surface.positions(vertex, 0);
    if (std::abs(x) < 1) continue;
    EXPECT_GT(weights.coeff(vertex, x > 0 ? 1 : 0), 0.85F) << x;
  }
  EXPECT_EQ(Eigen::MatrixXf(skin_weights(bar.surface, axis, first, {}, 2)).col(1).norm(), 0);
}

TEST(SkinWeights, AreLookedForUntilAStop) {
  const RigSubject& subject = rig_subjects().front();
  const Eigen::VectorXi joint_of_node = Eigen::VectorXi::Zero(subject.skeleton.nodes.rows());
  const SkinSources of_curve =
      sources_of_curve(subject.surface, subject.skeleton, joint_of_node, 1);
  const auto parts = split_components(subject.surface, topology(subject.surface));
  const std::vector<Bone> bones{{0, subject.skeleton.nodes.row(0), subject.skeleton.nodes.row(1)}};
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW((void)sources_of_bones(subject.surface, subject.skeleton, parts, bones, of_curve, 1,
                                      stop.get_token()),
               Cancelled);
}

}  // namespace
}  // namespace curveskel::skin_weights_laws
