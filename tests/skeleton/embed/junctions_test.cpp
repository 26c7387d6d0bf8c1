#include "skeleton/embed/place/junctions.hpp"

#include <gtest/gtest.h>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::junction_laws {
namespace {

/// Two junctions in the middle of a rod of radius 1, `apart` from each other, with two leaves each
/// and an arc that makes a detour between them.
SkeletonGraph two_junctions(double apart) {
  const Point from(-apart / 2, 0, 0);
  const Point to(apart / 2, 0, 0);
  SkeletonGraph graph;
  graph.nodes = {{from, {}, true, {0, 1, 2}}, {to, {}, true, {0, 3, 4}}};
  std::vector<CurvePoint> detour;
  for (int k = 1; k < 10; ++k) detour.emplace_back(Point(from + k * (to - from) / 10));
  detour.back() = CurvePoint(Point(to + Point(0, 0.2, 0)));
  graph.arcs = {{0, 1, detour, {}}};
  for (const auto& [node, x] :
       {std::pair(0, -4.0), std::pair(0, -3.0), std::pair(1, 3.0), std::pair(1, 4.0)}) {
    const int arc = static_cast<int>(graph.arcs.size());
    graph.nodes.push_back({Point(x, 0.1 * arc, 0), {}, true, {arc}});
    graph.arcs.push_back({node, arc + 1, {}, {}});
  }
  return graph;
}

// A cow's trunk had a step before the chest: one point of it was left, in the ball of a junction.
TEST(StraightenAtJunctions, LeavesNoPointBetweenBallsThatOverlap) {
  const SurfaceTree rod(shapes::tube("rod", shapes::straight(12), shapes::constant(1), 32).surface);
  for (const double apart : {0.5, 1.0, 1.5}) {
    SkeletonGraph graph = two_junctions(apart);
    straighten_at_junctions(graph, rod, 0.9, true);
    EXPECT_TRUE(graph.arcs[0].points.empty()) << apart;
  }
  for (const double apart : {2.5, 4.0}) {
    SkeletonGraph graph = two_junctions(apart);
    straighten_at_junctions(graph, rod, 0.9, true);
    EXPECT_FALSE(graph.arcs[0].points.empty()) << apart;
  }
}

}  // namespace
}  // namespace curveskel::junction_laws
