// Laws of levels of detail above the default: what is drawn beside the curve, and nothing moves.
#include <curveskel/extract.hpp>
#include <curveskel/levels.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/lives/finer_branches.hpp"
#include "tests/volumes.hpp"

namespace curveskel::finer_branches_laws {
namespace {

/// A ball of radius 1 with round bumps that stick so far out of it.
shapes::Shape bumpy_ball(int bumps, double height) {
  constexpr double radius = 0.35;
  const CurveSkeleton ends = shapes::star(bumps, 1 + height - radius, radius);
  const Eigen::Index count = ends.edges.rows();
  CurveSkeleton graph;
  graph.nodes = Positions::Zero(1 + 2 * count, 3);
  graph.radii = Eigen::VectorXd::Constant(1 + 2 * count, radius);
  graph.radii[0] = 1;
  graph.edges.resize(2 * count, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::RowVector3d end =
        ends.nodes.row(ends.edges(k, 1)) - ends.nodes.row(ends.edges(k, 0));
    graph.nodes.row(1 + 2 * k) = 0.5 * end.normalized();
    graph.nodes.row(2 + 2 * k) = end;
    graph.edges.row(k) << 0, static_cast<int>(1 + 2 * k);
    graph.edges.row(count + k) << static_cast<int>(1 + 2 * k), static_cast<int>(2 + 2 * k);
  }
  return shapes::tube_union("bumps " + std::to_string(bumps) + " " + std::to_string(height), graph,
                            {0.1, 3});
}

std::vector<shapes::Shape> subjects() {
  std::vector<shapes::Shape> all;
  for (const double height : {0.2, 0.4}) all.push_back(bumpy_ball(6, height));
  all.push_back(shapes::tube_union("y", shapes::star(3, 8, 0.8)));
  all.push_back(shapes::tube_union("ladder", shapes::ladder(2, 4, 0.5)));
  all.push_back(shapes::box({3, 2, 1}, 6));
  all.push_back(shapes::torus(3, 1, 24));
  all.push_back(shapes::noisy(shapes::tube_union("h", shapes::letter_h(6, 4, 0.6)), 0.05, 3));
  all.push_back(shapes::random_tubes(4));
  return all;
}

constexpr std::array details{0.5, 0.7, 0.85, 1.0};

Extraction at(const Surface& surface, double detail) {
  ExtractOptions options;
  options.embed.detail = detail;
  return extract(surface, options, {});
}

std::set<std::array<double, 3>> places_of(const CurveSkeleton& skeleton) {
  std::set<std::array<double, 3>> places;
  for (const auto& p : skeleton.nodes.rowwise()) places.insert({p[0], p[1], p[2]});
  return places;
}

TEST(FinerBranches, AddToWhatIsThereAndMoveNothing) {
  for (const shapes::Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    std::set<std::array<double, 3>> before;
    int tips_before = 0;
    for (const double detail : details) {
      SCOPED_TRACE(detail);
      const Extraction found = at(shape.surface, detail);
      const auto places = places_of(found.skeleton);
      EXPECT_TRUE(std::includes(places.begin(), places.end(), before.begin(), before.end()));
      before = places;
      const GraphTopology counted = graph_topology(found.skeleton);
      EXPECT_EQ(counted.components, 1);
      EXPECT_EQ(counted.cycle_rank, shape.genus);
      EXPECT_GE(counted.tips, tips_before);
      tips_before = counted.tips;
      EXPECT_TRUE(found.certificate.topology_correct());
      EXPECT_EQ(found.certificate.inside_fraction, 1);
    }
  }
}

TEST(FinerBranches, HaveNodesRadiiLivesAndVertices) {
  for (const shapes::Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    const CurveSkeleton usual = at(shape.surface, 0.5).skeleton;
    const CurveSkeleton finest = at(shape.surface, 1).skeleton;
    ASSERT_EQ(finest.radii.size(), finest.nodes.rows());
    EXPECT_GT(finest.radii.minCoeff(), 0);
    EXPECT_EQ(finest.node_of_vertex.size(), shape.surface.positions.rows());
    EXPECT_LT(finest.node_of_vertex.maxCoeff(), finest.nodes.rows());
    ASSERT_TRUE(has_lives(finest));
    const std::set<std::array<double, 3>> before = places_of(usual);
    const std::vector<int> degree = degrees(finest.nodes.rows(), finest.edges);
    std::set<int> with_vertices(finest.node_of_vertex.begin(), finest.node_of_vertex.end());
    for (int node = 0; node < static_cast<int>(finest.nodes.rows()); ++node) {
      const Eigen::RowVector3d p = finest.nodes.row(node);
      if (degree[idx(node)] != 1 || before.contains({p[0], p[1], p[2]})) continue;
      EXPECT_GT(finest.lives[node], 0);
      EXPECT_TRUE(with_vertices.contains(node));
    }
  }
}

/// Bumps too low for the default have branches at the finest level, all of them.
/// A ring with round bumps on its inner and its outer side.
Surface bumpy_ring() {
  const auto field = [](const Eigen::Vector3d& p) {
    return std::min({volumes::ring(p, 1, 0.35), volumes::ball(p, {0.65, 0, 0.1}, 0.15),
                     volumes::ball(p, {0, 1.35, 0.1}, 0.15),
                     volumes::ball(p, {-0.75, -0.8, 0.2}, 0.2)});
  };
  return volumes::Volume(field, {1.6, 1.7, 0.6}, 0.07).surface();
}

// The half of a ring on a bump's side of the plane through the bump's foot went to its branch.
TEST(FinerBranches, TakeNoVerticesFromNearerNodes) {
  std::vector<Surface> surfaces{bumpy_ring()};
  for (const shapes::Shape& shape : subjects()) surfaces.push_back(shape.surface);
  for (const Surface& surface : surfaces) {
    const CurveSkeleton plain = at(surface, 0.5).skeleton;
    const CurveSkeleton fine = at(surface, 1).skeleton;
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
      const auto off = [&](const CurveSkeleton& skeleton) {
        return (skeleton.nodes.row(skeleton.node_of_vertex[v]) - surface.positions.row(v)).norm();
      };
      ASSERT_LE(off(fine), off(plain) + 1e-12) << v;
    }
  }
}

TEST(FinerBranches, ReachEachBump) {
  for (const int bumps : {3, 6, 8}) {
    const shapes::Shape shape = bumpy_ball(bumps, 0.35);
    SCOPED_TRACE(shape.name);
    EXPECT_EQ(graph_topology(at(shape.surface, 0.5).skeleton).tips, 2);
    const CurveSkeleton finest = at(shape.surface, 1).skeleton;
    const std::vector<int> degree = degrees(finest.nodes.rows(), finest.edges);
    const CurveSkeleton ways = shapes::star(bumps, 1, 1);
    for (const auto& way : ways.nodes.rowwise()) {
      if (way.norm() < 0.5) continue;  // the middle
      bool reached = false;
      for (Eigen::Index node = 0; node < finest.nodes.rows(); ++node) {
        const bool is_near = (finest.nodes.row(node) - way).norm() < 0.3;
        reached = reached || (degree[idx(node)] == 1 && is_near);
      }
      EXPECT_TRUE(reached) << way;
    }
  }
}

/// A ball with so many thin spikes, evenly spread along a spiral.
Surface spiky_ball(int count, double width, double height) {
  std::vector<Eigen::RowVector3d> spikes;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1) / double(count);
    const double angle = 2 * std::numbers::pi * std::numbers::phi * i;
    spikes.emplace_back(std::sqrt(1 - z * z) * std::cos(angle),
                        std::sqrt(1 - z * z) * std::sin(angle), z);
  }
  Surface ball = shapes::ellipsoid({1, 1, 1}, 6).surface;
  for (auto row : ball.positions.rowwise()) {
    double nearest = 2;
    for (const Eigen::RowVector3d& spike : spikes) {
      nearest = std::min(nearest, (row.normalized() - spike).norm());
    }
    row *= 1 + height * std::exp(-nearest * nearest / (width * width));
  }
  return ball;
}

/// Beside each other the cut and the growth lose some, which stay in life at a detail of 0.
TEST(FinerBranches, OfTheClearestTipsAreThereByDefault) {
  const CurveSkeleton curve = extract(spiky_ball(100, 0.06, 0.8)).skeleton;
  EXPECT_EQ(graph_topology(curve).tips, 100);
}

TEST(FinerBranches, TheirLimitFallsFromTheDefaultOn) {
  EXPECT_EQ(least_deficit(0), least_deficit(0.5));
  for (std::size_t k = 1; k < details.size(); ++k) {
    EXPECT_LT(least_deficit(details[k]), least_deficit(details[k - 1]));
  }
}

/// A curve that has shrunk to next to nothing is no measure for what is drawn from it.
TEST(FinerBranches, HaveNoMorePointsThanTheSpacingAsksFor) {
  const shapes::Shape ball = bumpy_ball(6, 0.4);
  constexpr double spacing = 0.01;
  for (const double length : {1e-2, 1e-5, 1e-12}) {
    CurveSkeleton speck;
    speck.nodes.setZero(2, 3);
    speck.nodes(1, 0) = length;
    speck.edges = Edges(1, 2);
    speck.edges << 0, 1;
    speck.radii.setConstant(2, 0.9);
    speck.lives.setZero(2);
    speck.node_of_vertex.setZero(ball.surface.positions.rows());
    const SurfaceTree tree(ball.surface);
    const int drawn =
        add_finer_branches(speck, ball.surface, tree, tip_lives(ball.surface), {}, 0.1, spacing);
    EXPECT_GT(drawn, 0);
    const double most = 10 * bounding_box_diagonal(ball.surface.positions) / spacing;
    EXPECT_LT(static_cast<double>(speck.nodes.rows()), drawn * most);
  }
}

}  // namespace
}  // namespace curveskel::finer_branches_laws
