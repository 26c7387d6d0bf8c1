#include <curveskel/certificate.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/certify/tube_share.hpp"
#include "skeleton/certify/verdict.hpp"

namespace curveskel::certificate_laws {
namespace {

using Eigen::Vector3d;
using shapes::Shape;

constexpr double pi = std::numbers::pi;

// Tubes of even radius about curves that bend gently.
std::vector<Shape> even_tubes() {
  return {shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 24),
          shapes::tube("arc", shapes::arc(1, 2), shapes::constant(0.15), 24),
          shapes::tube("helix", shapes::helix(1, 1.2, 1.5), shapes::constant(0.15), 24),
          shapes::torus(1, 0.2, 24)};
}

Certificate certify(const Shape& shape, const CurveSkeleton& skeleton) {
  return evaluate(shape.surface, skeleton, {}, {});
}

CurveSkeleton chain(const std::vector<Vector3d>& points) {
  CurveSkeleton skeleton;
  const auto count = static_cast<Eigen::Index>(points.size());
  skeleton.nodes.resize(count, 3);
  skeleton.edges.resize(std::max<Eigen::Index>(count - 1, 0), 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    skeleton.nodes.row(i) = points[static_cast<std::size_t>(i)];
    if (i > 0) skeleton.edges.row(i - 1) << static_cast<int>(i) - 1, static_cast<int>(i);
  }
  return skeleton;
}

CurveSkeleton moved(CurveSkeleton skeleton, const Vector3d& offset) {
  skeleton.nodes.rowwise() += offset.transpose();
  return skeleton;
}

CurveSkeleton chain_pair(const CurveSkeleton& one, const CurveSkeleton& other) {
  CurveSkeleton both;
  both.nodes.resize(one.nodes.rows() + other.nodes.rows(), 3);
  both.nodes << one.nodes, other.nodes;
  both.edges.resize(one.edges.rows() + other.edges.rows(), 2);
  both.edges << one.edges, (other.edges.array() + static_cast<int>(one.nodes.rows())).matrix();
  return both;
}

// A new tip joined to a node.
CurveSkeleton with_tip(CurveSkeleton skeleton, int node, const Vector3d& tip) {
  const Eigen::Index nodes = skeleton.nodes.rows();
  skeleton.nodes.conservativeResize(nodes + 1, 3);
  skeleton.nodes.row(nodes) = tip;
  Edges edges(skeleton.edges.rows() + 1, 2);
  Eigen::Index row = 0;
  for (Eigen::Index e = 0; e < skeleton.edges.rows(); ++e) {
    if (row == e && skeleton.edges(e, 0) > node) edges.row(row++) << node, static_cast<int>(nodes);
    edges.row(row++) = skeleton.edges.row(e);
  }
  if (row < edges.rows()) edges.row(row) << node, static_cast<int>(nodes);
  skeleton.edges = edges;
  return skeleton;
}

// Every edge cut into `pieces`.
CurveSkeleton finer(const CurveSkeleton& skeleton, int pieces) {
  CurveSkeleton result;
  const Eigen::Index nodes = skeleton.nodes.rows();
  const Eigen::Index edges = skeleton.edges.rows();
  result.nodes.resize(nodes + edges * (pieces - 1), 3);
  result.nodes.topRows(nodes) = skeleton.nodes;
  std::vector<std::pair<int, int>> rows;
  for (Eigen::Index e = 0; e < edges; ++e) {
    int last = skeleton.edges(e, 0);
    const Vector3d a = skeleton.nodes.row(skeleton.edges(e, 0));
    const Vector3d b = skeleton.nodes.row(skeleton.edges(e, 1));
    for (int k = 1; k < pieces; ++k) {
      const auto node = static_cast<int>(nodes + e * (pieces - 1) + k - 1);
      result.nodes.row(node) = a + (b - a) * k / pieces;
      rows.emplace_back(std::min(last, node), std::max(last, node));
      last = node;
    }
    rows.emplace_back(std::min(last, skeleton.edges(e, 1)), std::max(last, skeleton.edges(e, 1)));
  }
  std::sort(rows.begin(), rows.end());
  result.edges.resize(static_cast<Eigen::Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.edges.row(static_cast<Eigen::Index>(i)) << rows[i].first, rows[i].second;
  }
  return result;
}

void expect_same(const Certificate& a, const Certificate& b, double tolerance) {
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.cycle_rank, b.cycle_rank);
  EXPECT_EQ(a.tips, b.tips);
  EXPECT_EQ(a.junctions, b.junctions);
  EXPECT_EQ(a.spurs, b.spurs);
  EXPECT_NEAR(a.length, b.length, tolerance);
  EXPECT_NEAR(a.inside_fraction, b.inside_fraction, tolerance);
  EXPECT_NEAR(a.deepest_exit, b.deepest_exit, tolerance);
  EXPECT_NEAR(a.centredness_median, b.centredness_median, tolerance);
  EXPECT_NEAR(a.centredness_p90, b.centredness_p90, tolerance);
  EXPECT_NEAR(a.coverage, b.coverage, tolerance);
  EXPECT_NEAR(a.reach, b.reach, tolerance);
  EXPECT_NEAR(a.reach_at_tips, b.reach_at_tips, tolerance);
  EXPECT_NEAR(a.total_curvature, b.total_curvature, tolerance);
}

TEST(Certificate, TheAxisOfATubeIsPerfect) {
  for (const Shape& shape : even_tubes()) {
    SCOPED_TRACE(shape.name);
    const Certificate certificate = certify(shape, shape.axis);
    EXPECT_TRUE(certificate.topology_correct());
    EXPECT_TRUE(certificate.inside_enough);
    EXPECT_EQ(certificate.inside_fraction, 1);
    EXPECT_EQ(certificate.deepest_exit, 0);
    EXPECT_LT(certificate.centredness_median, 0.02);
    EXPECT_LT(certificate.centredness_p90, 0.05);
    EXPECT_EQ(certificate.coverage, 1);
    EXPECT_LT(certificate.reach, 0.005);
    EXPECT_EQ(certificate.spurs, 0);
  }
}

TEST(Certificate, TotalCurvatureIsTheAngleThatTheCurveTurnsThrough) {
  const Shape ring = shapes::torus(1, 0.2, 24);
  const double diagonal = bounding_box_diagonal(ring.surface.positions);
  const Certificate circle = certify(ring, ring.axis);
  EXPECT_NEAR(circle.total_curvature * circle.length, 2 * pi, 0.02);
  EXPECT_NEAR(circle.length * diagonal, 2 * pi, 0.02);

  const Certificate line = certify(ring, chain({{0, 0, 0}, {0.3, 0.1, 0.2}}));
  EXPECT_NEAR(line.total_curvature, 0, 1e-6);
  const Certificate corner = certify(ring, chain({{0.5, 0, 0}, {0, 0, 0}, {0, 0.5, 0}}));
  EXPECT_NEAR(corner.total_curvature * corner.length, pi / 2, 1e-6);
}

TEST(Certificate, AShiftedCurveIsOffCentreByAsMuch) {
  const Shape shape = shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 48);
  double last = 0;
  for (const double shift : {0.1, 0.3, 0.5}) {
    const CurveSkeleton skeleton = moved(shape.axis, {0, 0.15 * shift, 0});
    const Certificate certificate = certify(shape, skeleton);
    EXPECT_EQ(certificate.inside_fraction, 1);
    // Of the chords from a point off the centre of a circle, to second order.
    EXPECT_NEAR(certificate.centredness_median, shift / std::sqrt(2.0), 0.06 * shift + 0.005);
    EXPECT_GT(certificate.centredness_median, last);
    last = certificate.centredness_median;
  }
}

TEST(Certificate, ACurveOutsideIsReportedWithItsDepth) {
  const Shape shape = shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 48);
  const double diagonal = bounding_box_diagonal(shape.surface.positions);
  const Certificate out = certify(shape, moved(shape.axis, {0, 0.15 * 1.5, 0}));
  EXPECT_EQ(out.inside_fraction, 0);
  EXPECT_FALSE(out.inside_enough);
  EXPECT_NEAR(out.deepest_exit, 0.075 / diagonal, 0.002);
  EXPECT_TRUE(std::isinf(out.centredness_median));
  EXPECT_EQ(out.coverage, 0);

  const Certificate partly = certify(shape, chain({{0, 0, 0}, {0, 0.3, 0}}));
  EXPECT_NEAR(partly.inside_fraction, 0.5, 0.02);
  EXPECT_NEAR(partly.deepest_exit, 0.15 / diagonal, 0.002);
}

TEST(Certificate, HalfAnAxisCoversHalf) {
  const Shape shape = shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 24);
  const double diagonal = bounding_box_diagonal(shape.surface.positions);
  const Certificate half = certify(shape, chain({{-1, 0, 0}, {0, 0, 0}}));
  EXPECT_NEAR(half.coverage, 0.55, 0.06);
  // 95 % of the vertices lie before x = 0.9 or so, the last ball ends at about 0.15.
  EXPECT_NEAR(half.reach, 0.85 / diagonal, 0.1);
  EXPECT_EQ(half.inside_fraction, 1);
}

TEST(Certificate, SpursAreLeafBranchesWithinTheirJunctionsBall) {
  const Shape shape = shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 24);
  const CurveSkeleton axis = chain({{-1, 0, 0}, {-0.4, 0, 0}, {0.3, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(certify(shape, axis).spurs, 0);
  const CurveSkeleton one = with_tip(axis, 1, {-0.4, 0.1, 0});
  const Certificate certificate = certify(shape, one);
  EXPECT_EQ(certificate.spurs, 1);
  EXPECT_EQ(certificate.tips, 3);
  EXPECT_EQ(certificate.junctions, 1);
  EXPECT_EQ(certify(shape, with_tip(one, 2, {0.3, 0, 0.1})).spurs, 2);
  EXPECT_EQ(certify(shape, with_tip(axis, 1, {-0.4, 0.16, 0})).spurs, 0)
      << "longer than the radius";
  EXPECT_EQ(certify(shape, chain({{0, 0, 0}, {0.01, 0, 0}})).spurs, 0) << "has no junction";
}

TEST(Certificate, TopologyIsComparedWithTheSurface) {
  const Shape ring = shapes::torus(1, 0.2, 16);
  EXPECT_TRUE(certify(ring, ring.axis).topology_correct());
  const Certificate open = certify(ring, chain({{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(open.cycle_rank, 0);
  EXPECT_EQ(open.genus, 1);
  EXPECT_FALSE(open.topology_correct());
  const Shape two = shapes::linked_rings(1, 0.2, 16);
  EXPECT_FALSE(certify(two, ring.axis).topology_correct());
  EXPECT_TRUE(certify(two, two.axis).topology_correct());
}

TEST(Certificate, EachComponentNeedsACurveOfItsOwn) {
  const Shape tube = shapes::tube("tube", shapes::straight(10), shapes::constant(0.5), 16);
  const Vector3d middle = tube.axis.nodes.colwise().mean().transpose();
  const Vector3d along = (tube.axis.nodes.bottomRows(1) - tube.axis.nodes.topRows(1)).transpose();
  const auto piece = [&](double from, double to) {
    return chain({middle + from * along, middle + to * along});
  };
  const CurveSkeleton one_piece = piece(-0.45, -0.05);
  const CurveSkeleton other_piece = piece(0.05, 0.45);
  const Vector3d across = along.unitOrthogonal();
  // Beside each other, one across the other, and one within the other.
  for (const double apart : {3.0, 0.2, 0.0}) {
    SCOPED_TRACE(apart);
    const Shape second = shapes::translated(apart > 0 ? tube : shapes::scaled(tube, 0.5),
                                            apart > 0 ? Vector3d(apart * across) : 0.5 * middle);
    const Shape both = shapes::together("both", {tube, second});
    const CurveSkeleton in_second = moved(one_piece, apart * across);
    EXPECT_TRUE(certify(both, chain_pair(other_piece, in_second)).topology_correct());
    if (apart > 1) {
      const Certificate fooled = certify(both, chain_pair(one_piece, other_piece));
      EXPECT_EQ(fooled.components, fooled.components_of_surface);
      EXPECT_EQ(fooled.components_without_curve, 1);
      EXPECT_FALSE(fooled.correct());
      EXPECT_NE(failures(fooled, {}).find("1 of the surface's 2"), std::string::npos);
    }
  }
}

TEST(Certificate, SizeAndPlaceDoNotMatter) {
  const Shape shape =
      shapes::tube_union("Y", shapes::star(3, 1, 0.15), shapes::TubeUnionOptions{0.25, 2});
  const CurveSkeleton skeleton = moved(shape.axis, {0.02, 0.03, 0.01});
  const Certificate original = certify(shape, skeleton);
  EXPECT_GT(original.centredness_median, 0.05);
  for (const double factor : {1e-6, 1e6}) {
    CurveSkeleton scaled = skeleton;
    scaled.nodes *= factor;
    expect_same(certify(shapes::scaled(shape, factor), scaled), original, 1e-6);
  }
  const Vector3d offset(200, -100, 300);
  expect_same(certify(shapes::translated(shape, offset), moved(skeleton, offset)), original, 1e-6);
}

TEST(Certificate, HowFinelyTheCurveIsCutDoesNotMatter) {
  for (const Shape& shape : even_tubes()) {
    SCOPED_TRACE(shape.name);
    const CurveSkeleton skeleton = moved(shape.axis, {0.02, 0.03, 0.01});
    expect_same(certify(shape, finer(skeleton, 7)), certify(shape, skeleton), 2e-3);
  }
}

TEST(Certificate, TheNumberOfThreadsDoesNotMatter) {
  const Shape shape = shapes::linked_rings(1, 0.2, 16);
  const CurveSkeleton skeleton = moved(shape.axis, {0.02, 0.03, 0.01});
  CertificateOptions options;
  options.threads = 1;
  const Certificate one = evaluate(shape.surface, skeleton, options, {});
  options.threads = 5;
  expect_same(evaluate(shape.surface, skeleton, options, {}), one, 0);
}

/// However thin the limb, and though half of its area is near the curve.
TEST(Certificate, ATipThatStopsHalfWayIsFound) {
  for (const double radius : {0.1, 0.01, 0.001}) {
    SCOPED_TRACE(radius);
    const Shape rod = shapes::tube("rod", shapes::straight(2), shapes::constant(radius), 24);
    const double diagonal = bounding_box_diagonal(rod.surface.positions);
    const double end = rod.surface.positions.col(0).maxCoeff() - radius;
    const Certificate half = certify(rod, chain({{0.4 - end, 0, 0}, {0, 0, 0}, {end, 0, 0}}));
    EXPECT_TRUE(half.correct() && half.curve_like);
    EXPECT_FALSE(half.holds());
    EXPECT_NEAR(half.reach_at_tips, 0.4 / diagonal, 0.002);
    EXPECT_NE(tip_failure(half), "");
    const Certificate whole = certify(rod, chain({{-end, 0, 0}, {0, 0, 0}, {end, 0, 0}}));
    EXPECT_TRUE(whole.holds());
    EXPECT_LT(whole.reach_at_tips, 0.002);
    EXPECT_EQ(tip_failure(whole), "");
  }
}

/// Nothing is missing beyond a tip from which another branch goes on.
TEST(Certificate, ATipMayLookAlongAnotherBranch) {
  const Shape rod = shapes::tube("rod", shapes::straight(2), shapes::constant(0.1), 24);
  CurveSkeleton forked = chain({{-0.9, 0, 0}, {0, 0, 0}, {0.9, 0, 0}, {0.2, 0.04, 0}});
  forked.edges << 0, 1, 1, 2, 1, 3;
  EXPECT_TRUE(certify(rod, forked).reaches_ends());
  const Certificate ring = certify(shapes::torus(1, 0.2, 24), shapes::torus(1, 0.2, 24).axis);
  EXPECT_EQ(ring.reach_at_tips, 0);
}

TEST(Certificate, ALoneNodeIsASkeletonOfABall) {
  const Shape ball = shapes::ellipsoid({1, 1, 1}, 4);
  const Certificate certificate = certify(ball, chain({{0, 0, 0}}));
  EXPECT_TRUE(certificate.topology_correct());
  EXPECT_EQ(certificate.inside_fraction, 1);
  EXPECT_LT(certificate.centredness_p90, 0.01);
  EXPECT_EQ(certificate.coverage, 1);
  EXPECT_EQ(certificate.tube_share, 1);
  EXPECT_LT(certificate.reach, 0.01);
  EXPECT_EQ(certificate.total_curvature, 0);
}

TEST(Certificate, TubesStarsAndToriAreMadeOfTubes) {
  std::vector<Shape> tubular = even_tubes();
  tubular.push_back(shapes::linked_rings(1, 0.2, 16));
  for (const int arms : {3, 4, 6}) {
    tubular.push_back(shapes::tube_union("star", shapes::star(arms, 1, 0.1)));
  }
  for (const Shape& shape : tubular) {
    SCOPED_TRACE(shape.name);
    const Certificate found = certify(shape, shape.axis);
    EXPECT_GT(found.tube_share, 0.95);
    EXPECT_TRUE(found.curve_like);
    EXPECT_EQ(shape_failure(found), "");
  }
}

// Thinner than the samples of the curve are apart.
TEST(Certificate, TheAxisOfAHairCoversIt) {
  for (const double radius : {0.05, 0.002, 0.0005, 0.00005}) {
    SCOPED_TRACE(radius);
    const Shape hair = shapes::tube("hair", shapes::arc(1, 2), shapes::constant(radius), 12);
    const Certificate c = certify(hair, hair.axis);
    EXPECT_GT(c.coverage, 0.99);
    EXPECT_LT(c.reach, 0.5 * radius);
  }
}

TEST(Certificate, AHairIsMadeOfTubes) {
  const Shape hair = shapes::tube("hair", shapes::straight(1), shapes::constant(1.0 / 5000), 6);
  EXPECT_GT(certify(hair, chain({{-0.499, 0, 0}, {0.499, 0, 0}})).tube_share, 0.95);
}

TEST(Certificate, TubesOfAnySizeAreMadeOfTubes) {
  const Shape tube = shapes::tube("arc", shapes::arc(1, 2), shapes::constant(0.15), 24);
  for (const double size : {1e-140, 1e-90, 1e90, 1e140}) {
    SCOPED_TRACE(size);
    const Shape scaled = shapes::scaled(tube, size);
    EXPECT_GT(certify(scaled, scaled.axis).tube_share, 0.95);
  }
}

TEST(Certificate, PlatesDiscsAndBoxesOfSheetsAreNotMadeOfTubes) {
  const CurveSkeleton middle = chain({{-0.45, 0, 0}, {0.45, 0, 0}});
  const std::vector<Shape> flat = {shapes::box({1, 1, 0.02}, 1), shapes::box({1, 0.5, 0.02}, 20),
                                   shapes::ellipsoid({0.5, 0.5, 0.01}, 4)};
  for (const Shape& shape : flat) {
    SCOPED_TRACE(shape.name);
    const Certificate found = certify(shape, middle);
    EXPECT_LT(found.tube_share, 0.25);
    EXPECT_TRUE(found.correct());
    EXPECT_FALSE(found.curve_like);
    EXPECT_FALSE(found.holds());
    EXPECT_NE(shape_failure(found).find("not made of tubes"), std::string::npos);
  }
  std::vector<Shape> walls;
  for (const double side : {-0.5, 0.5}) {
    walls.push_back(shapes::translated(shapes::box({1, 1, 0.02}, 2), {0, 0, side}));
    walls.push_back(shapes::translated(shapes::box({0.02, 0.9, 0.9}, 2), {side, 0, 0}));
  }
  EXPECT_LT(
      certify(shapes::together("box of sheets", walls), moved(middle, {0, 0, 0.5})).tube_share,
      0.1);
}

// A rod within a tube, beside its curve: the tube is as wide as before.
TEST(Certificate, ATubeIsOneWhateverCrossesIt) {
  const Shape tube = shapes::tube("tube", shapes::straight(1), shapes::constant(0.2), 16);
  const Shape rod = shapes::tube("rod", shapes::straight(1.2), shapes::constant(0.02), 16);
  const Shape both = shapes::together("both", {tube, shapes::translated(rod, {0, 0.06, 0})});
  CurveSkeleton axis = chain({{-0.4, 0, 0}, {0.4, 0, 0}});
  EXPECT_LT(certify(both, axis).tube_share, 0.2) << "measured alone";
  axis.radii.setConstant(2, 0.2);
  EXPECT_GT(certify(both, axis).tube_share, 0.9);
}

// Area counts, not how finely it is divided; and a figure's size does not.
TEST(Certificate, TheShareMadeOfTubesIsThatOfTheShape) {
  for (const int cells : {1, 3, 24}) {
    for (const double size : {1.0, 1000.0}) {
      Shape strip = shapes::box({1, 0.1, 0.02}, cells);
      strip.axis = chain({{-0.48, 0, 0}, {0.48, 0, 0}});
      strip.axis.radii.setConstant(2, 0.01);
      strip = shapes::scaled(strip, size);
      // Near are 2 sqrt(0.025^2 - 0.01^2) of the width of the wide faces, nothing of the others.
      EXPECT_NEAR(certify(strip, strip.axis).tube_share, 2 * 0.0458 / 0.244, 0.02)
          << cells << ", " << size;
    }
  }
}

TEST(Certificate, NoSkeletonCoversNothing) {
  const Certificate none = certify(shapes::ellipsoid({1, 1, 1}, 2), {});
  EXPECT_FALSE(none.topology_correct());
  EXPECT_FALSE(none.inside_enough);
  EXPECT_EQ(none.coverage, 0);
  EXPECT_EQ(none.tube_share, 0);
  EXPECT_TRUE(std::isinf(none.reach));
}

TEST(Certificate, TheVerdictIsItsOwnWithoutTheOtherFigures) {
  const Shape ring = shapes::torus(1, 0.2, 16);
  const CurveSkeleton line = chain({{0.9, 0, 0}, {0, 0.9, 0}, {0, 3, 0}});
  for (const CurveSkeleton* const skeleton : {&ring.axis, &line}) {
    const CertifiedSurface surface{ring.surface, SurfaceTree(ring.surface),
                                   bounding_box_diagonal(ring.surface.positions), 1, 1};
    const Certificate whole = evaluate(surface, *skeleton, {}, {});
    const Certificate own = verdict(surface, *skeleton, {}, {});
    EXPECT_EQ(own.topology_correct(), whole.topology_correct());
    EXPECT_EQ(own.correct(), whole.correct());
    EXPECT_EQ(own.inside_fraction, whole.inside_fraction);
    EXPECT_EQ(own.deepest_exit, whole.deepest_exit);
    EXPECT_EQ(failures(own, {}), failures(whole, {}));
    // They take thousands of points and rays for each of a tree's leaves.
    EXPECT_EQ(own.tube_share, 0);
    EXPECT_EQ(own.coverage, 0);
    EXPECT_GT(whole.tube_share, 0);
    EXPECT_GT(whole.coverage, 0);
    EXPECT_EQ(tube_share(ring.surface, *skeleton, {}), whole.tube_share);
  }
}

TEST(Certificate, RefusesPositionsThatAreNoNumbers) {
  const Shape ball = shapes::ellipsoid({1, 1, 1}, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)certify(ball, chain({{0, 0, 0}, {nan, 0, 0}})), Error);
}

TEST(Certificate, StopsWhenAsked) {
  const Shape ball = shapes::ellipsoid({1, 1, 1}, 2);
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)evaluate(ball.surface, chain({{0, 0, 0}}), {}, monitor), Cancelled);
}

TEST(Hausdorff, OfAMovedCurveIsAtMostTheMove) {
  const CurveSkeleton graph = shapes::random_graph(3, 12, 2, 0.05);
  EXPECT_LT(hausdorff_distance(graph, graph, 0.01), 1e-12);
  EXPECT_LT(mean_distance(graph, graph, 0.01), 1e-12);
  const Vector3d offset(0.01, 0.02, -0.005);
  const double distance = hausdorff_distance(graph, moved(graph, offset), 0.01);
  EXPECT_LE(distance, offset.norm() * (1 + 1e-12));
  EXPECT_GT(distance, 0.5 * offset.norm());
}

TEST(Hausdorff, LooksBothWays) {
  const CurveSkeleton line = chain({{0, 0, 0}, {1, 0, 0}});
  const CurveSkeleton longer = chain({{0, 0, 0}, {3, 0, 0}});
  EXPECT_NEAR(hausdorff_distance(line, longer, 0.01), 2, 1e-12);
  EXPECT_NEAR(hausdorff_distance(longer, line, 0.01), 2, 1e-12);
  EXPECT_NEAR(mean_distance(line, longer, 0.001), 1.0 / 3, 1e-3);  // 0 there, 2/3 back
  EXPECT_NEAR(hausdorff_distance(line, chain({{0, 1, 0}}), 0.01), std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isinf(hausdorff_distance(line, {}, 0.01)));
  EXPECT_TRUE(std::isinf(mean_distance(line, {}, 0.01)));
}

TEST(Hausdorff, SeesTheMiddleOfLongEdges) {
  const CurveSkeleton direct = chain({{-1, 0, 0}, {1, 0, 0}});
  const CurveSkeleton round = chain({{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  EXPECT_NEAR(hausdorff_distance(direct, round, 0.001), 1, 1e-12);
  const CurveSkeleton away = with_tip(round, 0, {-1, -0.5, 0});
  // From (0, 0, 0) to the slope; every node of `direct` is a node of `away`.
  const CurveSkeleton flat = with_tip(with_tip(direct, 0, {0, 1, 0}), 0, {-1, -0.5, 0});
  EXPECT_NEAR(hausdorff_distance(flat, away, 0.001), std::sqrt(0.5), 0.002);
}

TEST(Hausdorff, IsWhatTryingEveryPairOfSamplesFinds) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const CurveSkeleton a = shapes::random_graph(seed, 10, 1, 0.05);
    const CurveSkeleton b = shapes::random_graph(seed + 10, 14, 3, 0.05);
    const CurveSkeleton samples_a = finer(a, 100);
    const CurveSkeleton samples_b = finer(b, 100);
    double expected = 0;
    const auto one_sided = [&](const Positions& from, const Positions& to) {
      for (Eigen::Index i = 0; i < from.rows(); ++i) {
        expected = std::max(expected, (to.rowwise() - from.row(i)).rowwise().norm().minCoeff());
      }
    };
    one_sided(samples_a.nodes, samples_b.nodes);
    one_sided(samples_b.nodes, samples_a.nodes);
    EXPECT_NEAR(hausdorff_distance(a, b, 0.002), expected, 0.01);
  }
}

// Where the longer one goes on alone, into what may be wide and flat, is nothing to compare.
TEST(CommonGround, IsWhereBothRun) {
  const Shape shape = shapes::tube("straight", shapes::straight(2), shapes::constant(0.15), 48);
  const SurfaceTree tree(shape.surface);
  const double diagonal = bounding_box_diagonal(shape.surface.positions);
  const CurveSkeleton whole = chain({{-0.9, 0, 0}, {0.9, 0, 0}});
  const CurveSkeleton half = chain({{-0.9, 0.045, 0}, {0, 0.045, 0}});
  const auto [a, b] = common_ground(tree, diagonal, whole, half, {}, {});
  const double beyond = std::sqrt(0.15 * 0.15 - 0.045 * 0.045);  // its end's, seen from the axis
  EXPECT_NEAR(a.share, (0.9 + beyond) / 1.8, 0.01);
  EXPECT_NEAR(b.share, 1, 1e-12);
  EXPECT_LT(a.centredness_median, 0.02);
  EXPECT_NEAR(b.centredness_median, 0.3 / std::sqrt(2.0), 0.02);

  const auto [c, d] = common_ground(tree, diagonal, half, whole, {}, {});
  EXPECT_EQ(c.share, b.share);
  EXPECT_EQ(d.centredness_median, a.centredness_median);

  const CurveSkeleton away = chain({{3, 0, 0}, {4, 0, 0}});
  const auto [e, f] = common_ground(tree, diagonal, whole, away, {}, {});
  EXPECT_EQ(e.share, 0);
  EXPECT_TRUE(std::isinf(e.centredness_median));
  EXPECT_EQ(f.share, 0);
}

}  // namespace
}  // namespace curveskel::certificate_laws
