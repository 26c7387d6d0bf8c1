// Where joints are: on chains, corners, stars, heads and rings, for which it is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/joints.hpp>
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::joint_places_laws {
namespace {

using std::numbers::pi;

constexpr double sample = 0.25;  // radii: how finely places are tried

double nearest_joint(const Joints& joints, const Eigen::RowVector3d& point) {
  return (joints.positions.rowwise() - point).rowwise().norm().minCoeff();
}

/// Of each joint to its parent, without the root's.
std::vector<double> bones(const Joints& joints) {
  std::vector<double> lengths;
  for (Eigen::Index joint = 1; joint < joints.parents.size(); ++joint) {
    lengths.push_back(
        (joints.positions.row(joint) - joints.positions.row(joints.parents[joint])).norm());
  }
  return lengths;
}

/// The least n + (q / n)^2 n over whole n.
std::size_t best_count(double quotient) {
  std::size_t count = 1;
  const auto cost = [&](std::size_t n) {
    return static_cast<double>(n) + quotient * quotient / static_cast<double>(n);
  };
  while (cost(count + 1) < cost(count)) ++count;
  return count;
}

TEST(JointPlaces, CutAStraightChainIntoBonesOfOneLength) {
  for (const double radius : {0.01, 1.0, 30.0}) {
    for (const double length : {1.0, 5.3, 17.0, 44.0}) {  // in radii
      for (const double bone_length : {2.0, 6.0, 15.0}) {
        for (const double step : {0.2, 1.7, 50.0}) {
          SCOPED_TRACE(testing::Message() << "radius " << radius << ", length " << length
                                          << ", bones " << bone_length << ", step " << step);
          const CurveSkeleton chain =
              chain_through({{1, 2, 3}, {1 + length * radius, 2, 3}}, radius, step * radius);
          const std::vector<double> found =
              bones(place_joints(chain, {.bone_length = bone_length, .straight_bone = 0}));
          const double bones_in_it = length / bone_length;  // near a tie either may win
          EXPECT_GE(found.size(), best_count(0.98 * bones_in_it));
          EXPECT_LE(found.size(), best_count(1.02 * bones_in_it));
          const auto [least, most] = std::minmax_element(found.begin(), found.end());
          EXPECT_LE(*most - *least, 1.01 * sample * radius);
        }
      }
    }
  }
}

TEST(JointPlaces, AreNearerToEachOtherWhereAChainIsThin) {
  constexpr double bone_length = 6;
  CurveSkeleton chain = chain_through({{0, 0, 0}, {60, 0, 0}}, 1, 0.5);
  const auto radius_at = [](double x) { return 2 * std::pow(0.96, x); };
  for (Eigen::Index node = 0; node < chain.nodes.rows(); ++node) {
    chain.radii[node] = radius_at(chain.nodes(node, 0));
  }
  const Joints joints =
      place_joints(chain, {.bone_length = bone_length, .straight_bone = 0, .least_bone = 0});
  EXPECT_EQ(joints.positions(0, 0), 0);  // from the thick end
  ASSERT_GE(joints.parents.size(), 8);
  for (Eigen::Index joint = 1; joint < joints.parents.size(); ++joint) {
    const double from = joints.positions(joint - 1, 0);
    const double to = joints.positions(joint, 0);
    const double wanted = bone_length * radius_at((from + to) / 2);
    EXPECT_GT(to - from, 0.75 * wanted) << joint;
    EXPECT_LT(to - from, 1.35 * wanted) << joint;
  }
}

/// Thin limbs, straight and winding, on a thick body.
CurveSkeleton spiny_body(double spine_radius) {
  CurveSkeleton body = chain_through({{0, 0, 0}, {20, 0, 0}}, 1, 0.5);
  const auto attach = [&](const CurveSkeleton& limb, int at) {
    const Eigen::Index first = body.nodes.rows();
    const Eigen::Index edges = body.edges.rows();
    body.nodes.conservativeResize(first + limb.nodes.rows(), 3);
    body.nodes.bottomRows(limb.nodes.rows()) = limb.nodes.rowwise() + body.nodes.row(at);
    body.radii.conservativeResize(body.nodes.rows());
    body.radii.tail(limb.nodes.rows()) = limb.radii;
    body.edges.conservativeResize(edges + limb.edges.rows() + 1, 2);
    body.edges.middleRows(edges, limb.edges.rows()) = limb.edges.array() + static_cast<int>(first);
    body.edges.bottomRows(1) << at, static_cast<int>(first);
  };
  attach(chain_through({{0, 0.2, 0}, {0, 6, 0}}, spine_radius, 0.1), 10);
  attach(chain_through({{0, 0.2, 0}, {0, 0.3, 0}}, spine_radius, 0.1), 20);
  CurveSkeleton winding = chain_through({{0, 0, 0.2}, {0, 0, 8}}, spine_radius, 0.05);
  for (Eigen::Index node = 0; node < winding.nodes.rows(); ++node) {
    winding.nodes(node, 1) = 0.15 * std::sin(8 * winding.nodes(node, 2));
  }
  attach(winding, 30);
  return body;
}

TEST(JointPlaces, AreNoBeadsOnThinLimbs) {
  for (const double radius : {0.2, 0.05, 0.01}) {
    for (const double scale : {0.01, 1.0, 50.0}) {
      CurveSkeleton body = spiny_body(radius);
      body.nodes *= scale;
      body.radii *= scale;
      const Joints joints = place_joints(body);
      for (Eigen::Index joint = 0; joint < joints.parents.size(); ++joint) {
        if (joints.parents[joint] < 0) continue;
        const double bone =
            (joints.positions.row(joint) - joints.positions.row(joints.parents[joint])).norm();
        EXPECT_GE(bone, 0.02 * 20 * scale) << joints.names[idx(joint)] << " of " << radius;
      }
      // A stub shorter than the least bone has no joint; a straight spine of 6 is cut into bones of
      // .6, 3 % of 20, and the rest into no more than fit.
      Eigen::Index on_spine = 0;
      for (const auto& place : joints.positions.rowwise()) {
        const bool beside = std::abs(place.x() - 5 * scale) > 0.01 * scale;
        on_spine += !beside && place.y() > 0.1 * scale && std::abs(place.z()) < 0.1 * scale ? 1 : 0;
      }
      EXPECT_LE(on_spine, 12);
      EXPECT_LE(joints.parents.size(), (20 + 6 + 12) / 0.4);
    }
  }
}

TEST(JointPlaces, AreFewerWhereLongerBonesAreAskedFor) {
  for (const double radius : {0.02, 0.2, 1.0}) {
    const CurveSkeleton body = spiny_body(radius);
    std::vector<Eigen::Index> counts;  // of joints
    for (const double bone_length : {2.0, 4.0, 6.0, 9.0, 20.0}) {
      counts.push_back(place_joints(body, {.bone_length = bone_length}).parents.size());
    }
    EXPECT_TRUE(std::is_sorted(counts.rbegin(), counts.rend())) << "radius " << radius;
    EXPECT_GT(counts.front(), counts.back()) << "radius " << radius;
  }
}

TEST(JointPlaces, AreAtCorners) {
  for (const double turn : {pi / 3, pi / 2, 2 * pi / 3}) {
    for (const double first : {3.0, 4.3, 6.0, 9.5}) {
      for (const double second : {3.0, 5.1, 8.0}) {
        for (const double radius : {0.02, 1.0}) {
          SCOPED_TRACE(testing::Message() << "turn " << turn << ", arms " << first << " and "
                                          << second << ", radius " << radius);
          const Eigen::RowVector3d corner(first * radius, 0, 0);
          const Eigen::RowVector3d beyond(std::cos(turn), 0, std::sin(turn));
          const CurveSkeleton chain = chain_through(
              {{0, 0, 0}, corner, corner + second * radius * beyond}, radius, 0.3 * radius);
          for (const double bone_length : {6.0, 50.0}) {
            const Joints joints = place_joints(chain, {.bone_length = bone_length});
            EXPECT_LT(nearest_joint(joints, corner), 0.5 * radius) << bone_length;
          }
          EXPECT_EQ(place_joints(chain, {.bone_length = 50, .bend = 50}).parents.size(), 2);
        }
      }
    }
  }
}

/// Nor does it take long where there are very many.
TEST(JointPlaces, HardlyDependOnHowDenseTheNodesAre) {
  const auto placed = [](double step) {
    return place_joints(chain_through({{0, 0, 0}, {23, 0, 0}, {23, 9, 0}}, 1, step), {});
  };
  const Joints joints = placed(0.25);
  for (const double step : {0.1, 0.02, 0.001}) {
    const Joints other = placed(step);
    ASSERT_EQ(other.parents, joints.parents) << step;
    const double most = (other.positions - joints.positions).rowwise().norm().maxCoeff();
    EXPECT_LE(most, 2 * sample) << step;
  }
}

/// The joint above on the way to the root that hangs from joint 0 itself.
int first_of_limb(const Joints& joints, int joint) {
  while (joint > 0 && joints.parents[joint] > 0) joint = joints.parents[joint];
  return joint;
}

CurveSkeleton bare_star(int arms, double length, double ball) {
  CurveSkeleton star = shapes::star(arms, length, 1);
  for (Eigen::Index node = 0; node < star.nodes.rows(); ++node) {
    if (star.nodes.row(node).norm() < 1e-9) star.radii[node] = ball;
  }
  return star;
}

TEST(JointPlaces, LetEachArmOfAStarTurnWhereItLeavesTheBall) {
  for (const int arms : {3, 4, 7, 12}) {
    for (const double ball : {1.0, 2.5}) {
      SCOPED_TRACE(testing::Message() << arms << " arms, ball " << ball);
      const CurveSkeleton star = bare_star(arms, 9, ball);
      const Joints joints = place_joints(star, {});
      EXPECT_LT(joints.positions.row(0).norm(), 1e-9);
      std::set<int> firsts;
      for (Eigen::Index node = 0; node < star.nodes.rows(); ++node) {
        if (star.nodes.row(node).norm() < 1e-9) continue;
        const int own = first_of_limb(joints, joints.joint_of_node[node]);
        ASSERT_GT(own, 0);
        firsts.insert(own);
        const double way = joints.positions.row(own).norm();
        EXPECT_GE(way, ball * (1 - 1e-9));
        EXPECT_LE(way, ball * (1.001 + sample));
      }
      EXPECT_EQ(firsts.size(), idx(arms));
    }
  }
}

/// An arm that hardly leaves the ball of its junction is moved by the junction's joint.
TEST(JointPlaces, LeaveStubsToTheirJunction) {
  CurveSkeleton star = bare_star(3, 9, 2);
  for (Eigen::Index node = 0; node < star.nodes.rows(); ++node) star.nodes.row(node) *= 2.2 / 9;
  const Joints joints = place_joints(star, {});
  EXPECT_EQ(joints.positions.rows(), 4);
  EXPECT_TRUE((joints.joint_of_node.array() == 0).all());
}

/// Along x, a ball of this radius round its last node; what leads there has radius 1.
CurveSkeleton chain_with_head(double length, double head) {
  CurveSkeleton chain = chain_through({{0, 0, 0}, {length, 0, 0}}, 1, 0.2);
  for (Eigen::Index node = 0; node < chain.nodes.rows(); ++node) {
    chain.radii[node] = std::max(1.0, head - (length - chain.nodes(node, 0)));
  }
  return chain;
}

/// A twig too short for a bone does not divide its limb: at the middle, near the end, at both.
TEST(JointPlaces, AreThoseOfALimbWithoutItsTwigs) {
  for (const double length : {1.5, 20.0}) {
    const CurveSkeleton limb = chain_through({{0, 0, 0}, {length, 0, 0}}, 0.5, 0.05);
    const Joints without = place_joints(limb, {.root = 0, .least_bone = 1 / length});
    for (const std::vector<double>& places :
         {std::vector{0.5 * length}, {length - 0.7}, {0.3 * length, length - 0.7}}) {
      CurveSkeleton with = limb;
      for (const double place : places) {
        const auto node = static_cast<Eigen::Index>(std::lround(place / 0.05));
        const Eigen::Index twig = with.nodes.rows();
        with.nodes.conservativeResize(twig + 1, 3);
        with.nodes.row(twig) = with.nodes.row(node) + Eigen::RowVector3d(0, 0.6, 0);
        with.radii.conservativeResize(twig + 1);
        with.radii[twig] = 0.3;
        with.edges.conservativeResize(with.edges.rows() + 1, 2);
        with.edges.bottomRows(1) << static_cast<int>(node), static_cast<int>(twig);
      }
      std::vector<std::array<int, 2>> rows;
      for (const auto& edge : with.edges.rowwise()) rows.push_back({edge[0], edge[1]});
      std::sort(rows.begin(), rows.end());
      for (std::size_t e = 0; e < rows.size(); ++e) {
        with.edges.row(static_cast<Eigen::Index>(e)) << rows[e][0], rows[e][1];
      }
      const Joints found = place_joints(with, {.root = 0, .least_bone = 1 / length});
      EXPECT_EQ(found.positions, without.positions) << length << ", " << places.size();
      EXPECT_TRUE((found.joint_of_node.array() >= 0).all());
    }
  }
}

TEST(JointPlaces, LetAHeadTurnOnItsNeck) {
  for (const double head : {2.0, 2.5, 3.0}) {
    for (const double neck : {2.0, 4.0, 11.0}) {
      SCOPED_TRACE(testing::Message() << "head " << head << ", neck " << neck);
      const double length = neck + head;
      const CurveSkeleton chain = chain_with_head(length, head);
      const Joints joints = place_joints(chain, {.root = 0});
      const Eigen::Index last = joints.positions.rows() - 1;
      EXPECT_EQ(joints.positions(last, 0), length);
      const double entry = joints.positions(joints.parents[last], 0);
      EXPECT_LE(entry, neck + 1e-9);
      EXPECT_GE(entry, neck - 1.01 * sample);
    }
  }
}

/// A limb that ends no thicker than it was has no head.
TEST(JointPlaces, AreNotAtTheEdgeOfARoundCap) {
  const CurveSkeleton chain = chain_with_head(5, 1);
  EXPECT_EQ(place_joints(chain, {.root = 0}).positions.rows(), 2);
}

TEST(JointPlaces, GoRoundARingInOneChain) {
  for (const double ring_radius : {4.0, 9.0}) {
    for (const int count : {12, 60}) {
      SCOPED_TRACE(testing::Message() << "ring " << ring_radius << ", nodes " << count);
      std::vector<Eigen::RowVector3d> corners;
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * pi * k / count;
        corners.emplace_back(ring_radius * std::cos(angle), ring_radius * std::sin(angle), 0);
      }
      CurveSkeleton ring = chain_through(corners, 1, 1e9);
      ring.edges.conservativeResize(count, 2);
      for (int k = count - 2; k > 0; --k) ring.edges.row(k + 1) = ring.edges.row(k).eval();
      ring.edges.row(1) << 0, count - 1;
      const Joints joints = place_joints(ring, {});
      double around = 0;
      for (Eigen::Index joint = 1; joint < joints.parents.size(); ++joint) {
        EXPECT_EQ(joints.parents[joint], joint - 1);
        const Eigen::RowVector3d from = joints.positions.row(joint - 1);
        const Eigen::RowVector3d to = joints.positions.row(joint);
        const double turn = std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to));
        EXPECT_GT(turn * (around == 0 ? turn : around), 0);  // always the same way round
        EXPECT_LT(std::abs(turn), pi / 2);
        around += turn;
      }
      EXPECT_NEAR(std::abs(around), 2 * pi * (count - 1) / count, 1e-9);
    }
  }
}

TEST(JointPlaces, HangSmallerComponentsFromTheJointOfTheNearestNode) {
  const CurveSkeleton large = chain_through({{0, 0, 0}, {40, 0, 0}}, 1, 1);
  const CurveSkeleton small = chain_through({{26, 4, 0}, {26, 12, 0}}, 0.7, 1);
  const CurveSkeleton least = chain_through({{29, 10, 0}, {33, 10, 0}}, 0.3, 1);
  const CurveSkeleton all = curves_together({least, large, small});  // heavier ones may come later
  const Joints joints = place_joints(all, {});
  const auto joint_named = [&](const std::string& name) {
    const auto place = std::find(joints.names.begin(), joints.names.end(), name);
    return static_cast<int>(place - joints.names.begin());
  };
  const auto joint_of = [&](const Eigen::RowVector3d& point) {
    Eigen::Index node = -1;
    (all.nodes.rowwise() - point).rowwise().norm().minCoeff(&node);
    return joints.joint_of_node[node];
  };
  const int second = joint_named("part2_root");
  const int third = joint_named("part3_root");
  ASSERT_LT(third, joints.parents.size());
  EXPECT_EQ(joints.positions.row(0), Eigen::RowVector3d(20, 0, 0));  // the middle of the body
  EXPECT_EQ(joints.positions.row(second), small.nodes.row(0));
  EXPECT_EQ(joints.positions.row(third), least.nodes.row(0));
  EXPECT_EQ(joints.parents[second], joint_of({26, 0, 0}));
  EXPECT_EQ(joints.parents[third], joint_of({26, 10, 0}));
}

}  // namespace
}  // namespace curveskel::joint_places_laws
