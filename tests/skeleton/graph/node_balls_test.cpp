// Laws of the nearest ball: the one that asking all would give, without asking all.
#include "skeleton/graph/node_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace curveskel::node_balls_laws {
namespace {

/// A curve that winds through space, its nodes in any order.
CurveSkeleton shuffled_curve(int nodes, bool with_radii) {
  std::vector<int> order(static_cast<std::size_t>(nodes));
  for (int k = 0; k < nodes; ++k) order[static_cast<std::size_t>(k)] = k;
  std::mt19937 random(7);
  std::shuffle(order.begin(), order.end(), random);
  CurveSkeleton curve;
  curve.nodes.resize(nodes, 3);
  if (with_radii) curve.radii.resize(nodes);
  for (int k = 0; k < nodes; ++k) {
    const double t = 40.0 * order[static_cast<std::size_t>(k)] / nodes;
    curve.nodes.row(k) << std::cos(t) * (2 + std::cos(0.3 * t)), std::sin(t), 0.2 * t;
    if (with_radii) curve.radii[k] = 0.1 + 0.05 * std::sin(3 * t);
  }
  return curve;
}

int nearest_of_all(const CurveSkeleton& skeleton, const Eigen::Vector3d& point) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int node = 0; node < static_cast<int>(skeleton.nodes.rows()); ++node) {
    const double radius = skeleton.radii.size() > 0 ? skeleton.radii[node] : 0;
    const double distance = (point.transpose() - skeleton.nodes.row(node)).norm() - radius;
    if (distance < least) {
      least = distance;
      nearest = node;
    }
  }
  return nearest;
}

std::vector<Eigen::Vector3d> points_around(int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> anywhere(-4, 4);
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    points.emplace_back(anywhere(random), anywhere(random), 4 + anywhere(random));
  }
  return points;
}

TEST(NodeBalls, NearestIsThatOfAll) {
  for (const bool with_radii : {false, true}) {
    for (const int nodes : {1, 2, 9, 300}) {
      const CurveSkeleton curve = shuffled_curve(nodes, with_radii);
      const NodeBalls balls(curve);
      for (const auto& point : points_around(500)) {
        EXPECT_EQ(balls.nearest(point), nearest_of_all(curve, point));
      }
    }
  }
}

TEST(NodeBalls, OfEquallyNearOnesTheFirstIsTaken) {
  CurveSkeleton grid;
  grid.nodes.resize(125, 3);
  for (int k = 0; k < 125; ++k) grid.nodes.row(k) << k / 25 % 5, k / 5 % 5, k % 5;
  grid.nodes = grid.nodes.colwise().reverse().eval();
  const NodeBalls balls(grid);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3i halves(k / 100, k / 10 % 10, k % 10);
    const Eigen::Vector3d between = 0.5 * halves.cast<double>();
    EXPECT_EQ(balls.nearest(between), nearest_of_all(grid, between));
  }
  grid.nodes.resize(0, 3);
  EXPECT_EQ(NodeBalls(grid).nearest({0, 0, 0}), -1);
}

/// Every vertex of a large scan may ask: 10^10 distances if each looked at all nodes.
TEST(NodeBalls, AFewOfManyAreLookedAt) {
  const CurveSkeleton curve = shuffled_curve(100000, true);
  const NodeBalls balls(curve);
  long sum = 0;
  for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
    const Eigen::Vector3d beside = curve.nodes.row(k).transpose() + Eigen::Vector3d(0.1, 0.1, 0);
    sum += balls.nearest(beside) >= 0 ? 1 : 0;
  }
  EXPECT_EQ(sum, curve.nodes.rows());
}

}  // namespace
}  // namespace curveskel::node_balls_laws
