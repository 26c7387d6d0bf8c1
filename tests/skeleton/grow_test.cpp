// A part of the surface that the network leaves out gets its branch, whoever left it out.
#include "skeleton/grow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "meshes/shapes.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/tree.hpp"

namespace curveskel::grow_laws {
namespace {

/// One strand along the line, to which all of the surface belongs.
Network one_strand(const std::vector<Point>& line) {
  Network network;
  network.hubs = {{line.front(), {0}}, {line.back(), {0}}};
  network.hubs[0].strands = network.hubs[1].strands = {0};
  network.strands = {{0, 1, {line.begin() + 1, line.end() - 1}, {0}}};
  return network;
}

int grown(Network& network, const Surface& surface, double limit = 1.15) {
  const SurfaceTree tree(surface);
  VertexGraph graph;
  graph.groups = 1;
  graph.group_of_vertex = Eigen::VectorXi::Zero(surface.positions.rows());
  return grow_branches(network, surface, tree, inscribed_balls(surface, tree, 1), graph, limit);
}

int hubs_of_degree(const Network& network, int degree) {
  int count = 0;
  for (int h = 0; h < static_cast<int>(network.hubs.size()); ++h) {
    if (network.hubs[static_cast<std::size_t>(h)].alive && network.degree(h) == degree) ++count;
  }
  return count;
}

/// The arms of a star as nodes of its graph, the centre being node 0.
struct Star {
  explicit Star(int arms)
      : graph(shapes::star(arms, 6, 1)), surface(shapes::tube_union("star", graph).surface) {}
  [[nodiscard]] Point centre() const { return graph.nodes.row(0); }
  [[nodiscard]] Point end(int arm) const { return graph.nodes.row(arm + 1); }
  CurveSkeleton graph;
  Surface surface;
};

TEST(Growth, GivesEachArmLeftOutItsBranch) {
  for (const int arms : {3, 4, 5}) {
    const Star star(arms);
    Network network = one_strand({star.end(0), star.centre(), star.end(1)});
    EXPECT_EQ(grown(network, star.surface), arms - 2) << arms << " arms";
    EXPECT_EQ(hubs_of_degree(network, 1), arms) << arms << " arms";
    for (int arm = 2; arm < arms; ++arm) {
      double nearest = 100;
      for (const Hub& hub : network.hubs) {
        nearest = std::min(nearest, (hub.position - star.end(arm)).norm());
      }
      EXPECT_LT(nearest, 0.6) << "arm " << arm << " of " << arms;
    }
  }
}

TEST(Growth, LeavesAloneWhatHasAllItsBranches) {
  const auto limb = shapes::tube("limb", shapes::straight(8), shapes::constant(1), 24);
  const Point end(3.5, 0, 0);
  Network network = one_strand({-end, Point::Zero(), end});
  EXPECT_EQ(grown(network, limb.surface), 0);
}

TEST(Growth, GoesOnWhereAStrandEndsEarly) {
  const Star star(3);
  const Point early = 0.5 * (star.centre() + star.end(2));
  Network network = one_strand({star.end(0), star.centre(), star.end(1)});
  const int junction = network.split(0, 1, star.centre());
  network.add_leaf(junction, early, {0});
  EXPECT_EQ(grown(network, star.surface), 1);
  EXPECT_EQ(hubs_of_degree(network, 1), 3);
  EXPECT_EQ(hubs_of_degree(network, 3), 1);
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
  Network network = one_strand({{0, 0, -2.2}, {0, 0, 0}, {0, 0, 0.7}});
  ASSERT_EQ(grown(network, blunt_bar()), 1);
  const Point& tip = network.hubs.back().position;
  EXPECT_LT(std::hypot(tip.x(), tip.y()), 0.1);
  EXPECT_GT(tip.z(), 1.5);
}

TEST(Growth, LeavesOutWhatTheLimitSaysIsBlunt) {
  const Star star(3);
  Network network = one_strand({star.end(0), star.centre(), star.end(1)});
  EXPECT_EQ(grown(network, star.surface, 100), 0);
}

TEST(Growth, TakesNoNoiseForABranch) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto limb = shapes::noisy(
        shapes::tube("limb", shapes::straight(8), shapes::constant(0.5), 24), 0.002, seed);
    const Point end(3.8, 0, 0);
    Network network = one_strand({-end, Point::Zero(), end});
    EXPECT_EQ(grown(network, limb.surface), 0) << "seed " << seed;
  }
}

TEST(Network, SplitKeepsTheLineAndWhatBelongsToIt) {
  const std::vector<Point> line{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  for (std::size_t segment = 0; segment + 1 < line.size(); ++segment) {
    Network network = one_strand(line);
    const double before = network.length(network.strands[0]);
    const int hub = network.split(0, segment, 0.5 * (line[segment] + line[segment + 1]));
    EXPECT_EQ(network.degree(hub), 2);
    EXPECT_NEAR(network.length(network.strands[0]) + network.length(network.strands[1]), before,
                1e-12);
    EXPECT_EQ(network.strands[1].nodes, std::vector<int>{0});
    network.dissolve(hub);
    EXPECT_EQ(network.living_strands(), 1);
    EXPECT_EQ(hubs_of_degree(network, 1), 2);
  }
}

TEST(Network, SplitOpensAClosedStrand) {
  Network ring;
  ring.hubs = {{Point::Zero(), {0}}};
  ring.hubs[0].strands = {0};
  ring.strands = {{0, 0, {{1, 0, 0}, {1, 1, 0}}, {0}}};
  const int hub = ring.split(0, 1, {1, 0.5, 0});
  EXPECT_EQ(ring.degree(0), 2);
  EXPECT_EQ(ring.degree(hub), 2);
  ring.add_leaf(hub, {3, 0.5, 0}, {0});
  EXPECT_EQ(ring.degree(hub), 3);
  EXPECT_EQ(ring.living_strands(), 3);
}

}  // namespace
}  // namespace curveskel::grow_laws
