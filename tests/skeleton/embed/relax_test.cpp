// Laws of where points go: as dense as their surroundings are thin.
#include "skeleton/embed/place/relax.hpp"

#include <gtest/gtest.h>

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/place/spacing.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel::relax_laws {
namespace {

constexpr double most_spacing = 1.0 / 60;

SkeletonGraph arc_of(const std::vector<Point>& line) {
  SkeletonGraph graph;
  graph.nodes = {{line.front(), {0}}, {line.back(), {0}}};
  graph.arcs.push_back({0, 1, {line.begin() + 1, line.end() - 1}, {0}});
  for (Node& node : graph.nodes) node.arcs = {0};
  return graph;
}

TEST(Relax, PlacesPointsHalfOfTheirRadiusApart) {
  const SurfaceTree tree(
      shapes::tube("cone", shapes::straight(1), shapes::tapered(0.006, 0.03), 24).surface);
  std::vector<Point> line;
  for (double x = -0.45; x < 0.46; x += 0.01) line.emplace_back(x, 0, 0);
  SkeletonGraph graph = arc_of(line);
  space_by_radius(graph, tree, {1.0 / 400, 1});
  const auto spaced = graph.polyline(graph.arcs.front());
  const auto radii = graph.radii_along(graph.arcs.front(), tree);
  for (std::size_t i = 0; i + 1 < spaced.size(); ++i) {
    const double share = 2 * (spaced[i + 1] - spaced[i]).norm() / (radii[i] + radii[i + 1]);
    EXPECT_NEAR(share, 0.5, 0.05) << "at " << spaced[i].x();
  }
  space_by_radius(graph, tree, {1.0 / 400, most_spacing / 4});
  const auto dense = graph.polyline(graph.arcs.front());
  for (std::size_t i = 0; i + 1 < dense.size(); ++i) {
    EXPECT_LT((dense[i + 1] - dense[i]).norm(), 1.01 * most_spacing / 4);
  }
}

/// Nothing to turn round: the next `keep_simple` gives such a curve its points.
TEST(Relax, LeavesAClosedArcWithoutPointsAsItIs) {
  const SurfaceTree tree(shapes::torus(1, 0.3, 12).surface);
  SkeletonGraph graph;
  graph.nodes = {{Point(1, 0, 0), {0}, true, {0}}};
  graph.arcs.push_back({0, 0, {}, {0}});
  RelaxOptions options;
  options.rounds = 2;
  HomologyGuard guard;
  relax(graph, tree, tree, options, guard, 1);
  EXPECT_EQ(graph.nodes.front().point.place(), Point(1, 0, 0));
  EXPECT_TRUE(graph.arcs.front().points.empty());
}

}  // namespace
}  // namespace curveskel::relax_laws
