// A curve that is led inside keeps its cycles on their handles.
#include "skeleton/embed/contain/inside.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/measures.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/cut/level_set_graph.hpp"

namespace curveskel::inside_laws {
namespace {

/// A closed arc through these points, the first of which is its only node.
SkeletonGraph closed_arc(const PartitionGraph& partition, const std::vector<Point>& points) {
  SkeletonGraph graph =
      skeleton_graph_of(partition, std::vector<Point>(idx(partition.nodes()), points.front()));
  const auto nodes = static_cast<int>(graph.nodes.size());
  for (int node = 0; node < nodes; ++node) {
    if (graph.degree(node) == 1) graph.prune(graph.nodes[idx(node)].arcs.front());
  }
  for (int node = 0; node < nodes; ++node) {
    if (graph.nodes[idx(node)].alive && graph.degree(node) == 2) graph.dissolve(node);
  }
  for (Arc& arc : graph.arcs) {
    if (arc.alive) arc.points.assign(points.begin() + 1, points.end());
  }
  return graph;
}

// Two ways below the surface, of which each alone closed the arc round the handle, went the same
// way round the ring: to and fro.
TEST(KeepInside, LeadsAllStretchesOfAnArcRoundAHandleTogether) {
  const shapes::Shape ring = shapes::torus(3, 0.4, 16);
  const double size = bounding_box_diagonal(ring.surface.positions);
  const LevelSetGraph cut =
      level_set_graph({ring.surface.positions / size, ring.surface.triangles}, {});
  const SurfaceTree tree(cut.surface);
  const InscribedBalls balls = inscribed_balls(cut.surface, tree, 1);
  const WorkingSurface working(cut.surface, balls);
  for (const int corners : {2, 3, 4}) {  // of a polygon whose edges cross the hole
    std::vector<Point> points;
    for (int k = 0; k < corners; ++k) {
      const double angle = 0.3 + 2 * std::numbers::pi * k * (corners == 4 ? 0.49 : 1.0 / corners);
      points.emplace_back(3 / size * std::cos(angle), 3 / size * std::sin(angle), 0);
    }
    HomologyGuard guard(cut.surface);
    SkeletonGraph graph = closed_arc(cut.graph, points);
    ASSERT_EQ(graph.living_arcs(), 1);
    const InsideOptions options{.below = &cut.surface};
    EXPECT_EQ(keep_inside(graph, working, cut.graph, tree, guard, options), 0) << corners;
    EXPECT_TRUE(guard.finds_all_handles(graph, cut.graph)) << corners;
  }
}

}  // namespace
}  // namespace curveskel::inside_laws
