// Laws of tangles: triangles at random are refused, and nothing else is taken for them.
#include "surface/repair/tangles.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"
#include "tests/surface/repair_subjects.hpp"

namespace curveskel::tangle_laws {
namespace {

TEST(Tangles, OfFacesWithTheNumbersOfOtherVerticesAreRefused) {
  for (const shapes::Shape& shape :
       {shapes::ellipsoid({3, 2, 1}, 4), shapes::torus(3, 1, 32), shapes::torus(3, 1, 48),
        shapes::torus(3, 1, 56), shapes::torus(2, 1, 64)}) {
    SCOPED_TRACE(shape.name);
    Surface tangle = shape.surface;
    std::mt19937 draw(7);
    std::vector<int> number(idx(tangle.positions.rows()));
    for (int& one : number) one = static_cast<int>(draw() % (number.size() / 4));
    tangle.triangles = tangle.triangles.unaryExpr([&](int corner) { return number[idx(corner)]; });
    expect_said(refusal_of(soup_of(tangle)), {"pass through one another", "--wrap all"});
    EXPECT_EQ(crossing_share(shape.surface), 0);
  }
}

/// A share of the vertices stand in one another's places; the faces stay as they were.
Surface shuffled(Surface surface, double share, unsigned seed) {
  std::mt19937 draw(seed);
  std::vector<Eigen::Index> some;
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    if (double(draw()) / double(std::mt19937::max()) < share) some.push_back(v);
  }
  for (std::size_t k = some.size(); k > 1; --k) {
    surface.positions.row(some[k - 1]).swap(surface.positions.row(some[draw() % k]));
  }
  return surface;
}

// Closed as they are, so that nothing is cut; fewer vertices in one another's places pass for
// spikes.
TEST(Tangles, OfVerticesInAnotherOrderAreRefused) {
  for (const shapes::Shape& shape :
       {shapes::ellipsoid({3, 2, 1}, 4), shapes::ellipsoid({3, 2, 1}, 5), shapes::torus(3, 1, 48),
        shapes::torus(2, 1, 64), shapes::tube_union("star", shapes::star(5, 3, 0.4))}) {
    SCOPED_TRACE(shape.name);
    for (const double share : {1.0, 0.5, 0.2}) {
      SCOPED_TRACE(share);
      const Surface tangle = shuffled(shape.surface, share, 3);
      EXPECT_TRUE(is_mostly_tangle(tangle)) << long_faces_on_a_line(tangle);
      expect_said(refusal_of(soup_of(tangle)), {"pass through one another", "--wrap all"});
    }
  }
}

// Noise of a fiftieth of the diagonal, on triangles ten times as fine, has more crossings than many
// a tangle; and long faces, many on one line, cross nothing in a plate with many holes.
TEST(Tangles, AreNotSeenInNoiseAndInFineWork) {
  for (const shapes::Shape& shape :
       {shapes::ellipsoid({3, 2, 1}, 5), shapes::torus(3, 1, 64), shapes::sieve(9),
        shapes::tube_union("star", shapes::star(5, 3, 0.2))}) {
    SCOPED_TRACE(shape.name);
    EXPECT_FALSE(is_mostly_tangle(shape.surface)) << long_faces_on_a_line(shape.surface);
    const double diagonal = bounding_box_diagonal(shape.surface.positions);
    for (const double noise : {0.005, 0.01, 0.02}) {
      SCOPED_TRACE(noise);
      const Surface rough = shapes::noisy(shape, noise * diagonal, 5).surface;
      EXPECT_FALSE(is_mostly_tangle(rough)) << long_faces_on_a_line(rough);
    }
  }
}

}  // namespace
}  // namespace curveskel::tangle_laws
