// A part of the surface that the graph leaves out gets its branch, whoever left it out.
#include "skeleton/embed/branches/grow_branches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::grow_branches_laws {
namespace {

/// One arc along the line, to which all of the surface belongs.
SkeletonGraph one_arc(const std::vector<Point>& line) {
  SkeletonGraph graph;
  graph.nodes = {{line.front(), {0}}, {line.back(), {0}}};
  graph.nodes[0].arcs = graph.nodes[1].arcs = {0};
  graph.arcs = {{0, 1, {line.begin() + 1, line.end() - 1}, {0}}};
  return graph;
}

int grown(SkeletonGraph& graph, const Surface& surface, double limit = 1.15) {
  const SurfaceTree tree(surface);
  PartitionGraph partition;
  partition.groups = 1;
  partition.group_of_vertex = Eigen::VectorXi::Zero(surface.positions.rows());
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  return grow_branches(graph, {surface, balls}, tree, partition, limit);
}

int nodes_of_degree(const SkeletonGraph& graph, int degree) {
  int count = 0;
  for (int n = 0; n < static_cast<int>(graph.nodes.size()); ++n) {
    if (graph.nodes[static_cast<std::size_t>(n)].alive && graph.degree(n) == degree) ++count;
  }
  return count;
}

/// The arms of a star as nodes of its partition, the centre being node 0.
struct Star {
  explicit Star(int arms)
      : partition(shapes::star(arms, 6, 1)),
        surface(shapes::tube_union("star", partition).surface) {}
  [[nodiscard]] Point centre() const { return partition.nodes.row(0); }
  [[nodiscard]] Point end(int arm) const { return partition.nodes.row(arm + 1); }
  CurveSkeleton partition;
  Surface surface;
};

TEST(Growth, GivesEachArmLeftOutItsBranch) {
  for (const int arms : {3, 4, 5}) {
    const Star star(arms);
    SkeletonGraph graph = one_arc({star.end(0), star.centre(), star.end(1)});
    EXPECT_EQ(grown(graph, star.surface), arms - 2) << arms << " arms";
    EXPECT_EQ(nodes_of_degree(graph, 1), arms) << arms << " arms";
    for (int arm = 2; arm < arms; ++arm) {
      double nearest = 100;
      for (const Node& node : graph.nodes) {
        nearest = std::min(nearest, (node.point.place() - star.end(arm)).norm());
      }
      EXPECT_LT(nearest, 0.6) << "arm " << arm << " of " << arms;
    }
  }
}

TEST(Growth, LeavesAloneWhatHasAllItsBranches) {
  const auto limb = shapes::tube("limb", shapes::straight(8), shapes::constant(1), 24);
  const Point end(3.5, 0, 0);
  SkeletonGraph graph = one_arc({-end, Point::Zero(), end});
  EXPECT_EQ(grown(graph, limb.surface), 0);
}

TEST(Growth, GoesOnWhereAnArcEndsEarly) {
  const Star star(3);
  const Point early = 0.5 * (star.centre() + star.end(2));
  SkeletonGraph graph = one_arc({star.end(0), star.centre(), star.end(1)});
  const int junction = graph.split(0, 1, star.centre());
  graph.add_leaf(junction, early, {0});
  EXPECT_EQ(grown(graph, star.surface), 1);
  EXPECT_EQ(nodes_of_degree(graph, 1), 3);
  EXPECT_EQ(nodes_of_degree(graph, 3), 1);
}

/// A bar along z, its ends square with rounded corners, which lie farther out than their middles.
Surface blunt_bar() {
  constexpr double round = 0.53;
  Surface bar = shapes::box({2, 2, 6}, 60).surface;
  const Eigen::RowVector3d core(1 - round, 1 - round, 3 - round);
  for (auto p : bar.positions.rowwise()) {
    const Eigen::RowVector3d inner = p.cwiseMax(-core).cwiseMin(core);
    p = inner + round * (p - inner).normalized();
  }
  return bar;
}

TEST(Growth, EndsInTheMiddleOfABluntEnd) {
  SkeletonGraph graph = one_arc({{0, 0, -2.2}, {0, 0, 0}, {0, 0, 0.7}});
  ASSERT_EQ(grown(graph, blunt_bar()), 1);
  const Point& tip = graph.nodes.back().point.place();
  EXPECT_LT(std::hypot(tip.x(), tip.y()), 0.1);
  EXPECT_GT(tip.z(), 1.5);
}

TEST(Growth, LeavesOutWhatTheLimitSaysIsBlunt) {
  const Star star(3);
  SkeletonGraph graph = one_arc({star.end(0), star.centre(), star.end(1)});
  EXPECT_EQ(grown(graph, star.surface, 100), 0);
}

TEST(Growth, TakesNoNoiseForABranch) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto limb = shapes::noisy(
        shapes::tube("limb", shapes::straight(8), shapes::constant(0.5), 24), 0.002, seed);
    const Point end(3.8, 0, 0);
    SkeletonGraph graph = one_arc({-end, Point::Zero(), end});
    EXPECT_EQ(grown(graph, limb.surface), 0) << "seed " << seed;
  }
}

TEST(SkeletonGraph, SplitKeepsTheLineAndWhatBelongsToIt) {
  const std::vector<Point> line{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  for (std::size_t segment = 0; segment + 1 < line.size(); ++segment) {
    SkeletonGraph graph = one_arc(line);
    const double before = graph.length(graph.arcs[0]);
    const int node = graph.split(0, segment, 0.5 * (line[segment] + line[segment + 1]));
    EXPECT_EQ(graph.degree(node), 2);
    EXPECT_NEAR(graph.length(graph.arcs[0]) + graph.length(graph.arcs[1]), before, 1e-12);
    EXPECT_EQ(graph.arcs[1].pieces, std::vector<int>{0});
    graph.dissolve(node);
    EXPECT_EQ(graph.living_arcs(), 1);
    EXPECT_EQ(nodes_of_degree(graph, 1), 2);
  }
}

TEST(SkeletonGraph, SplitOpensAClosedArc) {
  SkeletonGraph ring;
  ring.nodes = {{Point(0, 0, 0), {0}, true, {0}}};
  ring.arcs = {{0, 0, {Point(1, 0, 0), Point(1, 1, 0)}, {0}}};
  const int node = ring.split(0, 1, Point(1, 0.5, 0));
  EXPECT_EQ(ring.degree(0), 2);
  EXPECT_EQ(ring.degree(node), 2);
  ring.add_leaf(node, {3, 0.5, 0}, {0});
  EXPECT_EQ(ring.degree(node), 3);
  EXPECT_EQ(ring.living_arcs(), 3);
}

}  // namespace
}  // namespace curveskel::grow_branches_laws
