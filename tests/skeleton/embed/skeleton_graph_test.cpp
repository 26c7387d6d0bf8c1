// Laws of what a graph leaves behind: every vertex gets a node.
#include "skeleton/embed/skeleton_graph.hpp"

#include <gtest/gtest.h>

namespace curveskel::skeleton_graph_laws {
namespace {

TEST(SkeletonGraph, GivesVerticesOfAGroupWithoutNodesTheNearestOfAll) {
  SkeletonGraph graph;
  graph.nodes = {{Point(0, 0, 0), {0}, true, {0}}, {Point(4, 0, 0), {2}, true, {0}}};
  graph.arcs.push_back({0, 1, {Point(2, 0, 0)}, {}});
  const EmbeddedNodes nodes = skeleton_of(graph, 3);
  ASSERT_TRUE(nodes.nodes_of_group[1].empty());
  Positions places(4, 3);
  places << 0.4, 1, 0, 2.9, 1, 0, 1.4, 1, 0, 3.9, 1, 0;
  const Eigen::VectorXi node_of = nearest_nodes(nodes, Eigen::Vector4i(0, 1, 1, 2), places);
  const auto place = [&](int vertex) {
    const int node = node_of[vertex];
    return node >= 0 && node < 3 ? nodes.skeleton.nodes(node, 0) : -1;
  };
  EXPECT_EQ(place(0), 0);
  EXPECT_EQ(place(1), 2);
  EXPECT_EQ(place(2), 2);
  EXPECT_EQ(place(3), 4);
}

}  // namespace
}  // namespace curveskel::skeleton_graph_laws
