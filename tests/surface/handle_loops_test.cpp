#include "surface/mesh/handle_loops.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::handle_loops_laws {
namespace {

using shapes::Shape;

std::vector<Shape> closed_shapes() {
  return {shapes::ellipsoid({1, 2, 3}, 2), shapes::torus(3, 1, 12), shapes::linked_rings(3, 0.5, 8),
          shapes::sieve(3),
          shapes::together("sieve-and-torus", {shapes::sieve(2), shapes::torus(40, 1, 9)})};
}

TEST(HandleLoops, AreTwiceAsManyAsTheHandles) {
  for (const Shape& shape : closed_shapes()) {
    const HandleLoops found = handle_loops(shape.surface);
    EXPECT_EQ(found.loops.size(), 2 * static_cast<std::size_t>(shape.genus)) << shape.name;
    EXPECT_EQ(found.components, shape.components) << shape.name;
  }
}

TEST(HandleLoops, AreClosedAndRunAlongEdgesOfTheSurface) {
  for (const Shape& shape : closed_shapes()) {
    SCOPED_TRACE(shape.name);
    std::set<std::pair<int, int>> edges;
    for (const auto& t : shape.surface.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) edges.insert(std::minmax({t(k), t((k + 1) % 3)}));
    }
    const HandleLoops found = handle_loops(shape.surface);
    for (const auto& [a, b] : found.edges) EXPECT_TRUE(edges.contains(std::minmax({a, b})));
    for (const auto& loop : found.loops) {
      std::map<int, int> degree;
      std::set<int> passed;
      for (const int edge : loop) {
        EXPECT_TRUE(passed.insert(edge).second) << "twice along one edge";
        for (const int v : found.edges[static_cast<std::size_t>(edge)]) ++degree[v];
      }
      EXPECT_FALSE(loop.empty());
      for (const auto& [vertex, count] : degree) EXPECT_EQ(count, 2) << vertex;
    }
  }
}

TEST(HandleLoops, FacesThatDisagreeAreRefusedByNumber) {
  Surface surface = shapes::torus(3, 1, 12).surface;
  std::swap(surface.triangles(5, 0), surface.triangles(5, 1));
  try {
    (void)handle_loops(surface);
    FAIL() << "no refusal";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find("found face "), std::string::npos);
  }
}

}  // namespace
}  // namespace curveskel::handle_loops_laws
