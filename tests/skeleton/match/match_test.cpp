// Which branch is which: of surfaces that are known to be the same, turned, noised, cut shorter.
#include <curveskel/match.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {
namespace {

using shapes::Shape;

struct Side {
  Surface surface;
  CurveSkeleton skeleton;
  [[nodiscard]] MatchSide as_given() const { return {surface, skeleton}; }
};

Side side_of(const Surface& surface) { return {surface, extract(surface).skeleton}; }

Shape turned(const Shape& shape) {
  return shapes::translated(shapes::rotated(shape, {0.3, 1, -0.4}, 2.1), {5, -7, 3});
}

/// As many vertices as telling branches apart takes.
const shapes::TubeUnionOptions coarse{0.25, 1.5};

/// Five limbs of different lengths from two junctions.
CurveSkeleton beast(double tail) {
  CurveSkeleton graph;
  graph.nodes.resize(7, 3);
  graph.nodes << 0, 0, 0,  // shoulders
      5, 0, 0,             // hips
      -2, 1.5, 0.5,        // head
      -0.5, -4, 1.5,       // front leg
      -0.5, -3.2, -2,      // the other, shorter
      5.5, -3.8, 0.8,      // hind leg
      5 + tail, 1, -0.5;   // tail
  graph.edges.resize(6, 2);
  graph.edges << 0, 1, 0, 2, 0, 3, 0, 4, 1, 5, 1, 6;
  graph.radii.resize(7);
  graph.radii << 0.6, 0.7, 0.5, 0.4, 0.35, 0.45, 0.3;
  return graph;
}

TEST(MatchSkeletons, FindEachBranchOfATurnedAndScaledSurface) {
  for (const int seed : {3, 21}) {
    SCOPED_TRACE(seed);
    const Shape shape = shapes::random_tubes(seed);
    const Side a = side_of(shape.surface);
    const Side b = side_of(shapes::scaled(turned(shape), 2.5).surface);
    const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
    ASSERT_EQ(match.branches.size(), branches(a.skeleton).size());
    const double size = bounding_box_diagonal(b.surface.positions);
    const auto of_a = branches(a.skeleton);
    const auto of_b = branches(b.skeleton);
    for (const BranchPair& pair : match.branches) {
      // The same vertices lie around both.
      const auto middle = [](const CurveSkeleton& skeleton, const Branch& branch) {
        const std::set<int> nodes(branch.nodes.begin(), branch.nodes.end());
        std::set<Eigen::Index> vertices;
        for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
          if (nodes.count(skeleton.node_of_vertex[v]) > 0) vertices.insert(v);
        }
        return vertices;
      };
      const auto mine = middle(a.skeleton, of_a[static_cast<std::size_t>(pair.a)]);
      const auto theirs = middle(b.skeleton, of_b[static_cast<std::size_t>(pair.b)]);
      std::size_t shared = 0;
      for (const Eigen::Index vertex : mine) shared += theirs.count(vertex);
      EXPECT_GT(2 * shared, mine.size());
      EXPECT_FALSE(pair.ambiguous);
    }
    int near = 0;
    for (Eigen::Index v = 0; v < match.vertex_of_a.size(); ++v) {
      const int found = match.vertex_of_a[v];
      if (found < 0) continue;
      const double off = (b.surface.positions.row(found) - b.surface.positions.row(v)).norm();
      near += off < 0.01 * size ? 1 : 0;
    }
    EXPECT_GT(near, 0.9 * static_cast<double>(match.vertex_of_a.size()));
  }
}

TEST(MatchSkeletons, TellWhatHasNoPartner) {
  const Shape whole = shapes::tube_union("beast", beast(4), coarse);
  CurveSkeleton docked = beast(4);
  docked.nodes.row(5) << 5.5, -3.8, 0.8;
  docked.nodes.conservativeResize(6, 3);
  docked.radii.conservativeResize(6);
  docked.edges.conservativeResize(5, 2);
  const Side a = side_of(whole.surface);
  const Side b = side_of(turned(shapes::tube_union("docked", docked, coarse)).surface);
  ASSERT_EQ(branches(a.skeleton).size(), 6U);
  ASSERT_EQ(branches(b.skeleton).size(), 4U);
  const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
  // Without the tail, trunk and hind leg are one branch, which is that of one of the two.
  EXPECT_EQ(match.branches.size(), 4U);
  const auto of_a = branches(a.skeleton);
  for (const BranchPair& pair : match.branches) {
    const int end = of_a[static_cast<std::size_t>(pair.a)].nodes.back();
    const int start = of_a[static_cast<std::size_t>(pair.a)].nodes.front();
    for (const int node : {start, end}) {
      EXPECT_LT(a.skeleton.nodes(node, 0), 7) << "the tail has a partner";
    }
  }
  // And the other way round.
  EXPECT_EQ(match_skeletons(b.as_given(), a.as_given()).branches.size(), 4U);
}

TEST(MatchSkeletons, FollowTheSurfaceWhereTheCurveAloneCannot) {
  // Left and right are alike in the curve; a bump in front tells them apart.
  CurveSkeleton figure;
  figure.nodes.resize(6, 3);
  figure.nodes << 0, 0, 0, 0, 4, 0, 3, 0, 0, -3, 0, 0, 0, -4, 0, 0, 2, 1.2;
  figure.edges.resize(5, 2);
  figure.edges << 0, 1, 0, 2, 0, 3, 0, 4, 0, 5;
  figure.radii.resize(6);
  figure.radii << 0.8, 0.6, 0.5, 0.5, 0.6, 0.5;
  const Shape shape = shapes::tube_union("figure", figure);
  const Side a = side_of(shape.surface);
  const Side b = side_of(turned(shape).surface);
  const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
  ASSERT_EQ(match.branches.size(), branches(a.skeleton).size());
  for (const BranchPair& pair : match.branches) EXPECT_FALSE(pair.ambiguous);
  int wrong = 0;
  const double size = bounding_box_diagonal(b.surface.positions);
  for (Eigen::Index v = 0; v < match.vertex_of_a.size(); ++v) {
    const int found = match.vertex_of_a[v];
    const auto off =
        found < 0 ? size : (b.surface.positions.row(found) - b.surface.positions.row(v)).norm();
    wrong += off > 0.05 * size ? 1 : 0;
  }
  EXPECT_LT(wrong, 0.05 * static_cast<double>(match.vertex_of_a.size()));
}

TEST(MatchSkeletons, SayWhereASymmetryLeavesTheChoice) {
  const Shape star = shapes::tube_union("star", shapes::star(3, 5, 1));
  const Side a = side_of(star.surface);
  const Side b = side_of(turned(star).surface);
  const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
  ASSERT_EQ(match.branches.size(), 3U);
  for (const BranchPair& pair : match.branches) EXPECT_TRUE(pair.ambiguous);
}

TEST(MatchSkeletons, PairRingsJunctionsAndComponents) {
  const Shape chain = shapes::tube_union("chain", shapes::ring_chain(2, 3, 0.6));
  const Shape ring = shapes::translated(shapes::torus(2, 0.4, 20), {0, 0, 9});
  const Shape both = shapes::together("both", {chain, ring});
  const Side a = side_of(both.surface);
  const Side b = side_of(turned(both).surface);
  const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
  EXPECT_EQ(match.branches.size(), branches(a.skeleton).size());
  EXPECT_EQ(static_cast<int>(match.junctions.size()), graph_topology(a.skeleton).junctions);
}

/// A ring like no turn of itself: an oval, thick on one side, out of its plane.
Surface odd_ring(int around, double first_angle) {
  Surface ring = shapes::torus(3, 0.5, around).surface;
  for (auto row : ring.positions.rowwise()) {
    const double angle = std::atan2(row.y(), row.x()) + first_angle;
    const Eigen::RowVector3d middle(3 * std::cos(angle), 2.1 * std::sin(angle),
                                    0.6 * std::sin(2 * angle));
    const double thick = 1 + 0.5 * std::cos(angle) + 0.15 * std::sin(3 * angle);
    const double out = thick * (std::hypot(row.x(), row.y()) - 3);
    const double up = thick * row.z();
    row = middle + out * Eigen::RowVector3d(std::cos(angle), std::sin(angle), 0) +
          up * Eigen::RowVector3d::UnitZ();
  }
  return ring;
}

TEST(MatchSkeletons, PutTheVerticesOfARingToTheirPlacesWhereverItsCurveBegins) {
  const Surface ring = odd_ring(24, 0);
  const Side a = side_of(ring);
  for (const double first_angle : {0.0, 2.5}) {
    for (const bool backwards : {false, true}) {
      SCOPED_TRACE(testing::Message() << first_angle << ", numbers backwards " << backwards);
      Shape other = shapes::torus(3, 0.5, 24);
      other.surface = odd_ring(29, first_angle);
      if (backwards) {
        other.surface.positions = other.surface.positions.colwise().reverse().eval();
        const auto last = static_cast<std::int32_t>(other.surface.positions.rows()) - 1;
        other.surface.triangles = (last - other.surface.triangles.array()).matrix().eval();
      }
      const Side b = side_of(turned(other).surface);
      const SkeletonMatch match = match_skeletons(a.as_given(), b.as_given());
      ASSERT_EQ(match.branches.size(), 1U);
      std::vector<double> off;
      for (Eigen::Index v = 0; v < match.vertex_of_a.size(); ++v) {
        ASSERT_GE(match.vertex_of_a[v], 0);
        const auto partner = other.surface.positions.row(match.vertex_of_a[v]);
        off.push_back((ring.positions.row(v) - partner).norm());
      }
      std::sort(off.begin(), off.end());
      const double diagonal = bounding_box_diagonal(ring.positions);
      EXPECT_LT(off[off.size() / 2], 0.03 * diagonal);
      EXPECT_LT(off[off.size() * 9 / 10], 0.06 * diagonal);
    }
  }
}

TEST(MatchSkeletons, AreTheSameFromAnyNumberOfThreadsAndRefuseWhatLacksAMap) {
  const Shape shape = shapes::tube_union("beast", beast(4), coarse);
  const Side a = side_of(shape.surface);
  Side b = side_of(turned(shape).surface);
  const SkeletonMatch one = match_skeletons(a.as_given(), b.as_given(), {1});
  const SkeletonMatch two = match_skeletons(a.as_given(), b.as_given(), {2});
  EXPECT_EQ(one.vertex_of_a, two.vertex_of_a);
  EXPECT_EQ(one.junctions, two.junctions);
  b.skeleton.node_of_vertex.resize(0);
  EXPECT_THROW((void)match_skeletons(a.as_given(), b.as_given()), Error);
}

/// A star of like limbs: nothing but its vertices tells which is which.
Shape star(int limbs) {
  CurveSkeleton graph;
  graph.nodes.setZero(limbs + 1, 3);
  graph.edges.resize(limbs, 2);
  graph.radii.setConstant(limbs + 1, 0.4);
  for (int k = 0; k < limbs; ++k) {
    const double angle = 2 * std::numbers::pi * k / limbs;
    graph.nodes.row(k + 1) << 4 * std::cos(angle), 4 * std::sin(angle), 0;
    graph.edges.row(k) << 0, k + 1;
  }
  return shapes::tube_union("star", graph);
}

struct Given {
  PolygonSoup soup;
  RepairedSurface repaired;
  CurveSkeleton skeleton;
  [[nodiscard]] MatchInput as_input() const { return {soup, repaired, skeleton}; }
};

Given given(const Surface& surface) {
  Given made{soup_of(surface), {}, {}};
  made.repaired = repair(made.soup);
  made.skeleton = extract(made.repaired.surface).skeleton;
  return made;
}

TEST(MatchInputs, KnowByVerticesWhatTheShapeLeavesOpen) {
  for (const int limbs : {3, 5}) {
    SCOPED_TRACE(limbs);
    const Shape shape = star(limbs);
    const Given a = given(shape.surface);
    const Given b = given(turned(shape).surface);
    const InputMatch by_vertices = match_inputs(a.as_input(), b.as_input());
    EXPECT_TRUE(by_vertices.by_vertices);
    ASSERT_EQ(by_vertices.match.branches.size(), static_cast<std::size_t>(limbs));
    EXPECT_EQ(by_vertices.match.junctions.size(), 1U);
    for (Eigen::Index v = 0; v < by_vertices.vertex_of_a.size(); ++v) {
      ASSERT_EQ(by_vertices.vertex_of_a[v], v);
    }
    const auto of_a = branches(a.skeleton);
    const auto of_b = branches(b.skeleton);
    for (const BranchPair& pair : by_vertices.match.branches) {
      EXPECT_FALSE(pair.ambiguous);
      const auto tip = [](const CurveSkeleton& skeleton, const Branch& branch) {
        const auto degree = degrees(skeleton.nodes.rows(), skeleton.edges);
        const int end = branch.nodes.back();
        return degree[static_cast<std::size_t>(end)] == 1 ? end : branch.nodes.front();
      };
      // The tips are where the vertices say.
      const Eigen::RowVector3d mine =
          a.skeleton.nodes.row(tip(a.skeleton, of_a[static_cast<std::size_t>(pair.a)]));
      const Eigen::RowVector3d theirs =
          b.skeleton.nodes.row(tip(b.skeleton, of_b[static_cast<std::size_t>(pair.b)]));
      Eigen::Index nearest = 0;
      (a.repaired.surface.positions.rowwise() - mine).rowwise().squaredNorm().minCoeff(&nearest);
      EXPECT_LT((b.repaired.surface.positions.row(nearest) - theirs).norm(), 1.0);
    }
    MatchOptions by_shape;
    by_shape.by_shape = true;
    const InputMatch alone = match_inputs(a.as_input(), b.as_input(), by_shape);
    EXPECT_FALSE(alone.by_vertices);
    for (const BranchPair& pair : alone.match.branches) EXPECT_TRUE(pair.ambiguous);
  }
}

TEST(MatchInputs, CompareShapesWhereTheFacesDiffer) {
  const Given a = given(star(3).surface);
  Surface other = star(3).surface;
  other.triangles.row(0).swap(other.triangles.row(1));
  EXPECT_FALSE(match_inputs(a.as_input(), given(other).as_input()).by_vertices);
}

/// A triangle for each face, with corners of its own, as STL has them.
PolygonSoup soup_of_apart(const Surface& surface) {
  PolygonSoup soup;
  soup.positions.resize(3 * surface.triangles.rows(), 3);
  soup.offsets = {0};
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (const int vertex : triangle) {
      const auto corner = static_cast<std::int32_t>(soup.corners.size());
      soup.positions.row(corner) = surface.positions.row(vertex);
      soup.corners.push_back(corner);
    }
    soup.offsets.push_back(static_cast<std::int64_t>(soup.corners.size()));
  }
  return soup;
}

TEST(MatchInputs, KnowCornersThatAreApartOnlyByHowTheyMeet) {
  const auto given_apart = [](const Surface& surface) {
    Given made{soup_of_apart(surface), {}, {}};
    made.repaired = repair(made.soup);
    made.skeleton = extract(made.repaired.surface).skeleton;
    return made;
  };
  const Shape shape = shapes::tube_union("beast", beast(4), coarse);
  const Surface& body = shape.surface;
  const Given a = given_apart(body);
  const InputMatch posed =
      match_inputs(a.as_input(), given_apart(turned(shape).surface).as_input());
  EXPECT_TRUE(posed.by_vertices);
  Surface shuffled = body;
  shuffled.triangles = body.triangles.colwise().reverse().eval();
  const Given b = given_apart(shuffled);
  const InputMatch match = match_inputs(a.as_input(), b.as_input());
  EXPECT_FALSE(match.by_vertices);
  for (Eigen::Index v = 0; v < match.vertex_of_a.size(); ++v) {
    ASSERT_GE(match.vertex_of_a[v], 0);
    const auto off = a.soup.positions.row(v) - b.soup.positions.row(match.vertex_of_a[v]);
    EXPECT_LT(off.norm(), 0.02 * bounding_box_diagonal(body.positions));
  }
}

TEST(MatchByVertices, TakeWhatIsKnownAndRefuseWhatCannotBe) {
  const Shape shape = shapes::tube_union("beast", beast(4), coarse);
  const Side a = side_of(shape.surface);
  const Side b = side_of(turned(shape).surface);
  const Eigen::Index count = a.surface.positions.rows();
  Eigen::VectorXi known = Eigen::VectorXi::LinSpaced(count, 0, static_cast<int>(count) - 1);
  // One vertex of five is enough.
  for (Eigen::Index v = 0; v < count; ++v) known[v] = v % 5 == 0 ? known[v] : -1;
  const SkeletonMatch match = match_by_vertices(a.as_given(), b.as_given(), known);
  EXPECT_EQ(match.branches.size(), branches(a.skeleton).size());
  EXPECT_EQ(match.junctions.size(), 2U);
  EXPECT_EQ(match.vertex_of_a, known);
  known[0] = static_cast<int>(count);
  EXPECT_THROW((void)match_by_vertices(a.as_given(), b.as_given(), known), Error);
  known.conservativeResize(count - 1);
  EXPECT_THROW((void)match_by_vertices(a.as_given(), b.as_given(), known), Error);
}

}  // namespace
}  // namespace curveskel
