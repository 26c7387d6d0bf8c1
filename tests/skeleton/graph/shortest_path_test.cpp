// Laws of shortest paths along a skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/edit.hpp>
#include <curveskel/error.hpp>
#include "tests/skeleton/graph/edited_skeletons.hpp"

namespace curveskel::shortest_path_laws {
namespace {

using namespace edited_skeletons;

/// Floyd and Warshall's, which has nothing in common with Dijkstra's.
Eigen::MatrixXd all_distances(const CurveSkeleton& skeleton) {
  const Eigen::Index nodes = skeleton.nodes.rows();
  Eigen::MatrixXd distance =
      Eigen::MatrixXd::Constant(nodes, nodes, std::numeric_limits<double>::infinity());
  distance.diagonal().setZero();
  for (const auto& edge : skeleton.edges.rowwise()) {
    const double length = (skeleton.nodes.row(edge[0]) - skeleton.nodes.row(edge[1])).norm();
    distance(edge[0], edge[1]) = distance(edge[1], edge[0]) = length;
  }
  for (Eigen::Index via = 0; via < nodes; ++via) {
    for (Eigen::Index a = 0; a < nodes; ++a) {
      for (Eigen::Index b = 0; b < nodes; ++b) {
        distance(a, b) = std::min(distance(a, b), distance(a, via) + distance(via, b));
      }
    }
  }
  return distance;
}

TEST(ShortestPath, IsAsLongAsNoOtherIsAndGoesAlongEdges) {
  int unreachable = 0;
  for (const Subject& subject : subjects()) {
    const CurveSkeleton& skeleton = subject.skeleton;
    const Eigen::MatrixXd distance = all_distances(skeleton);
    for (int a = 0; a < nodes_of(skeleton); a += 3) {
      for (int b = 0; b < nodes_of(skeleton); b += 2) {
        const Path path = shortest_path(skeleton, a, b);
        if (!std::isfinite(distance(a, b))) {
          EXPECT_TRUE(path.nodes.empty());
          ++unreachable;
          continue;
        }
        ASSERT_FALSE(path.nodes.empty());
        EXPECT_EQ(path.nodes.front(), a);
        EXPECT_EQ(path.nodes.back(), b);
        double length = 0;
        for (std::size_t k = 1; k < path.nodes.size(); ++k) {
          ASSERT_GE(edge_between(skeleton, path.nodes[k - 1], path.nodes[k]), 0);
          length +=
              (skeleton.nodes.row(path.nodes[k]) - skeleton.nodes.row(path.nodes[k - 1])).norm();
        }
        EXPECT_NEAR(length, path.length, 1e-12 * (1 + length));
        EXPECT_NEAR(path.length, distance(a, b), 1e-12 * (1 + length));
      }
    }
  }
  EXPECT_GT(unreachable, 0);
  EXPECT_THROW((void)shortest_path(subjects().front().skeleton, 0, -1), Error);
}

}  // namespace
}  // namespace curveskel::shortest_path_laws
