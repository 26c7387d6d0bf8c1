// Laws of the surgery by CGAL, with embedding and without.
#include "skeleton/cut/cgal_surgery.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/surgery.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/cut/as_contracted.hpp"

namespace curveskel::cgal_surgery_laws {
namespace {

using shapes::Shape;

const std::vector<Shape>& subjects() {
  static const std::vector<Shape> made = [] {
    std::vector<Shape> found;
    for (const auto& entry : shapes::catalogue()) {
      if (entry.name == "torus" || entry.name == "double-torus" || entry.name == "y" ||
          entry.name == "tube") {
        found.push_back(entry.make());
      }
    }
    return found;
  }();
  return made;
}

Contraction contracted(const Surface& surface, const ContractionOptions& options = {}) {
  return contract(surface, inscribed_balls(surface, SurfaceTree(surface), 1).centres, options, {});
}

void expect_total(const CurveSkeleton& skeleton, Eigen::Index vertices) {
  ASSERT_EQ(skeleton.node_of_vertex.size(), vertices);
  EXPECT_GE(skeleton.node_of_vertex.minCoeff(), 0);
  EXPECT_LT(skeleton.node_of_vertex.maxCoeff(), skeleton.nodes.rows());
}

ExtractOptions by_cgal(EmbedMethod embed) {
  ExtractOptions options;
  options.resolution = options.least_resolution = 1500;
  options.surgery.method = SurgeryMethod::cgal;
  options.embed.method = embed;
  return options;
}

TEST(CgalSurgery, HasTheComponentsAndCyclesAndEveryVertex) {
  ASSERT_EQ(subjects().size(), 4U);
  for (const Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    const CurveSkeleton skeleton = cgal_surgery(contracted(shape.surface));
    const GraphTopology found = graph_topology(skeleton);
    EXPECT_EQ(found.components, 1);
    EXPECT_EQ(found.cycle_rank, shape.cycles);
    EXPECT_GT(skeleton.nodes.rows(), 5);
    expect_total(skeleton, shape.surface.positions.rows());
    const std::set<int> met(skeleton.node_of_vertex.begin(), skeleton.node_of_vertex.end());
    EXPECT_EQ(static_cast<Eigen::Index>(met.size()), skeleton.nodes.rows()) << "empty nodes";
  }
}

TEST(CgalSurgery, ItsGroupsMeetAlongCirclesAndHaveNoHandle) {
  for (const Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    const Contraction contraction = contracted(shape.surface);
    SurgeryOptions options;
    options.method = SurgeryMethod::cgal;
    const auto graph = surgery(shape.surface, contraction, options, {});
    ASSERT_TRUE(graph.has_value());
    EXPECT_EQ(graph->edges.rows() - graph->nodes() + 1, shape.cycles);
    EXPECT_EQ(graph->groups, cgal_surgery(contraction).nodes.rows());
  }
}

TEST(CgalSurgery, NoGraphWhereAGroupKeepsAHandle) {
  // Not contracted at all, a body of 64 holes is merged in lumps that have some.
  const Shape sieve = shapes::sieve(8);
  ContractionOptions still;
  still.max_iterations = 0;
  const Contraction as_it_is = contracted(sieve.surface, still);
  EXPECT_NE(graph_topology(cgal_surgery(as_it_is)).cycle_rank, sieve.genus);
  SurgeryOptions options;
  options.method = SurgeryMethod::cgal;
  EXPECT_FALSE(surgery(sieve.surface, as_it_is, options, {}).has_value());
}

TEST(CgalSurgery, EmbeddedItsTopologyHoldsWhateverTheContractionLeft) {
  ExtractOptions options = by_cgal(EmbedMethod::own);
  std::vector<Shape> shapes = subjects();
  shapes.push_back(shapes::sieve(3));
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    const Extraction found = extract(shape.surface, options, {});
    EXPECT_TRUE(found.certificate.topology_correct());
    EXPECT_EQ(found.certificate.cycle_rank, shape.genus);
    EXPECT_DOUBLE_EQ(found.certificate.inside_fraction, 1);
    expect_total(found.skeleton, shape.surface.positions.rows());
  }
  options.contraction.max_iterations = 0;  // too little for any surgery: the last resort
  const Extraction found = extract(shapes::sieve(2).surface, options, {});
  EXPECT_TRUE(is_kept(found.history, try_level_sets));
  EXPECT_TRUE(found.certificate.topology_correct());
}

TEST(AsContracted, NodesStayWhereTheSurgeryLeavesThem) {
  for (const Shape& shape : subjects()) {
    for (const SurgeryMethod method : {SurgeryMethod::own, SurgeryMethod::cgal}) {
      SCOPED_TRACE(shape.name + " " + std::string(name_of(surgery_methods, method)));
      const Contraction contraction = contracted(shape.surface);
      SurgeryOptions options;
      options.method = method;
      const auto found = skeleton_as_contracted(shape.surface, contraction, options, {});
      EXPECT_FALSE(found.level_sets);
      EXPECT_EQ(graph_topology(found.skeleton).cycle_rank, shape.cycles);
      // A mean of contracted vertices lies in their box.
      const Positions& all = contraction.surface.positions;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(found.skeleton.nodes.col(axis).minCoeff(), all.col(axis).minCoeff() - 1e-9);
        EXPECT_LE(found.skeleton.nodes.col(axis).maxCoeff(), all.col(axis).maxCoeff() + 1e-9);
      }
    }
  }
}

TEST(AsContracted, ExtractionHasRadiiAVertexMapAndNoBallsItDoesNotNeed) {
  for (const Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    ExtractOptions options = by_cgal(EmbedMethod::none);
    options.fair_if_outside = options.all_vertices_if_failed = false;
    options.contraction.flow = Flow::paper;
    const Extraction found = extract(shape.surface, options, {});
    EXPECT_TRUE(found.certificate.topology_correct());
    expect_total(found.skeleton, shape.surface.positions.rows());
    const SurfaceTree tree(shape.surface);
    ASSERT_EQ(found.skeleton.radii.size(), found.skeleton.nodes.rows());
    for (Eigen::Index n = 0; n < found.skeleton.nodes.rows(); ++n) {
      const double radius = std::max(0.0, tree.inscribed_radius(found.skeleton.nodes.row(n)));
      EXPECT_NEAR(found.skeleton.radii[n], radius, 1e-5 * radius + 1e-6);
    }
    for (const StageTime& time : found.times) EXPECT_NE(time.stage, "balls");
  }
}

TEST(AsContracted, WhereTheSurgeryGivesUpItIsTheLevelSets) {
  const Shape sieve = shapes::sieve(3);
  ContractionOptions still;
  still.max_iterations = 0;
  const Contraction as_it_is = contracted(sieve.surface, still);
  ASSERT_FALSE(surgery(sieve.surface, as_it_is, {}, {}).has_value());
  const auto found = skeleton_as_contracted(sieve.surface, as_it_is, {}, {});
  EXPECT_TRUE(found.level_sets);
  EXPECT_EQ(graph_topology(found.skeleton).cycle_rank, sieve.genus);
  EXPECT_EQ(found.skeleton.node_of_vertex.size(), sieve.surface.positions.rows());
}

TEST(AsContracted, TheSameBytesForAnyNumberOfThreads) {
  ExtractOptions options = by_cgal(EmbedMethod::none);
  const Surface& surface = subjects().front().surface;
  const Extraction first = extract(surface, options, {});
  options.threads = options.certificate.threads = 1;
  const Extraction other = extract(surface, options, {});
  EXPECT_EQ(first.skeleton.nodes, other.skeleton.nodes);
  EXPECT_EQ(first.skeleton.edges, other.skeleton.edges);
  EXPECT_EQ(first.skeleton.radii, other.skeleton.radii);
  EXPECT_EQ(first.skeleton.node_of_vertex, other.skeleton.node_of_vertex);
}

}  // namespace
}  // namespace curveskel::cgal_surgery_laws
