// A curve does not squeeze past a hollow where there is more room on its other side.
#include "skeleton/embed/contain/bottleneck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/branches/grow_branches.hpp"
#include "skeleton/embed/contain/inside.hpp"
#include "skeleton/embed/place/relax.hpp"
#include "skeleton/embed/place/settle.hpp"

namespace curveskel::bottleneck_laws {
namespace {

constexpr double half_length = 5;

/// A bar along x of radius 2, into which a hollow leads from z = 2 down to z = `bottom`; what is
/// left of the bar beside the hollow is thin.
Surface hollow_bar(double bottom) {
  Surface bar =
      shapes::tube("bar", shapes::straight(2 * half_length), shapes::constant(2), 80).surface;
  const auto within = [](double x, double half_width) {
    return std::clamp(10 * (half_width - std::abs(x)), 0.0, 1.0);
  };
  for (auto p : bar.positions.rowwise()) {
    if (p.z() <= 0) continue;
    const double share = within(p.x(), 1) * within(p.y(), 1.6);
    p.z() += share * (bottom - p.z());
  }
  return bar;
}

SkeletonGraph arcs(const std::vector<std::vector<Point>>& between) {
  SkeletonGraph graph;
  graph.nodes = {{Point(-half_length, 0, 0), {0}}, {Point(half_length, 0, 0), {0}}};
  for (const auto& points : between) {
    const auto s = static_cast<int>(graph.arcs.size());
    graph.arcs.push_back({0, 1, {points.begin(), points.end()}, {0}});
    for (Node& node : graph.nodes) node.arcs.push_back(s);
  }
  return graph;
}

/// Past the hollow on one side of it.
std::vector<Point> beside(double y) {
  return {{-2, 0, 0}, {-1.2, y, 0.8}, {0, y, 0.8}, {1.2, y, 0.8}, {2, 0, 0}};
}

int taken(SkeletonGraph& graph, const Surface& surface) {
  const SurfaceTree tree(surface);
  PartitionGraph partition;
  partition.groups = 1;
  partition.group_of_vertex = Eigen::VectorXi::Zero(surface.positions.rows());
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  return reroute_bottlenecks(graph, {surface, balls}, partition, tree);
}

/// All that moves, adds or leads points: each may take long.
TEST(EmbeddingSteps, StopWhenAsked) {
  const Surface surface = hollow_bar(0);
  const SurfaceTree tree(surface);
  PartitionGraph partition;
  partition.groups = 1;
  partition.group_of_vertex = Eigen::VectorXi::Zero(surface.positions.rows());
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  const WorkingSurface working(surface, balls);
  HomologyGuard guard;
  std::stop_source source;
  source.request_stop();
  const std::stop_token stop = source.get_token();
  SkeletonGraph graph = arcs({beside(1.75)});
  RelaxOptions relaxing;
  relaxing.stop = stop;
  SettleOptions settling;
  settling.is_own = [](int, int) { return true; };
  settling.stop = stop;
  EXPECT_THROW(relax(graph, tree, tree, relaxing, guard, 2), Cancelled);
  EXPECT_THROW(settle(graph, tree, settling, guard, 2), Cancelled);
  EXPECT_THROW((void)keep_inside(graph, working, partition, tree, guard, {.stop = stop}),
               Cancelled);
  EXPECT_THROW((void)reroute_bottlenecks(graph, working, partition, tree, {}, stop), Cancelled);
  EXPECT_THROW((void)grow_branches(graph, working, tree, partition, 0, {}, stop), Cancelled);
}

TEST(Bottlenecks, AreReroutedPastAHollowWhereThereIsRoom) {
  for (const double side : {-1.75, 1.75}) {
    SkeletonGraph graph = arcs({beside(side)});
    ASSERT_EQ(taken(graph, hollow_bar(0)), 1);
    for (const Point& p : graph.polyline(graph.arcs[0])) {
      if (std::abs(p.x()) < 1) {
        EXPECT_LT(p.z(), -0.5);
        EXPECT_LT(std::abs(p.y()), 0.5);
      }
    }
  }
}

TEST(Bottlenecks, AreReroutedOnceOnly) {
  SkeletonGraph graph = arcs({beside(1.75)});
  const Surface bar = hollow_bar(0);
  ASSERT_EQ(taken(graph, bar), 1);
  EXPECT_EQ(taken(graph, bar), 0);
}

TEST(Bottlenecks, OnCyclesStay) {
  SkeletonGraph graph = arcs({beside(-1.75), beside(1.75)});
  EXPECT_EQ(taken(graph, hollow_bar(0)), 0);
}

TEST(Bottlenecks, WithNoWiderWayStay) {
  const auto waist =
      shapes::tube("waist", shapes::straight(2 * half_length), shapes::wavy(1, 0.7, 2), 40);
  SkeletonGraph graph = arcs({{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
  EXPECT_EQ(taken(graph, waist.surface), 0);
}

}  // namespace
}  // namespace curveskel::bottleneck_laws
