// Laws of the rig of all that is in a file, from the curve of all of it or of the body alone.
#include <curveskel/rig_character.hpp>

#include <gtest/gtest.h>

#include <string>

#include <curveskel/extract_repaired.hpp>
#include <curveskel/repair.hpp>
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"

namespace curveskel::rig_character_laws {
namespace {

using shapes::Shape;

Shape ball_at(double radius, const Eigen::Vector3d& middle) {
  return shapes::translated(shapes::ellipsoid({radius, radius, radius}, 2), middle);
}

/// A bent tube about the origin, and a button on it at either end; a button comes first.
Shape buttoned() {
  const Shape tube = shapes::tube("", shapes::s_curve(16, 6), shapes::constant(1), 16);
  const Positions& axis = tube.axis.nodes;
  const Eigen::Vector3d front = axis.row(axis.rows() / 5).transpose();
  const Eigen::Vector3d back = axis.row(4 * axis.rows() / 5).transpose();
  const Eigen::Vector3d up = 0.95 * Eigen::Vector3d::UnitZ();
  return shapes::together("", {ball_at(0.2, front + up), tube, ball_at(0.25, back + up)});
}

class RigCharacter : public testing::Test {
 protected:
  const Shape shape = buttoned();
  const RepairedSurface repaired = repair(soup_of(shape.surface));
  const CurveSkeleton of_all =
      extract_repaired(repaired, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
};

TEST_F(RigCharacter, IsTheSameFromTheCurveOfAllAndOfTheBodyAlone) {
  const CharacterRig from_all = rig_character(shape.surface, repaired, of_all);
  ASSERT_EQ(from_all.parts.parts.size(), 3U);
  EXPECT_TRUE(from_all.parts.parts[0].follows);
  EXPECT_FALSE(from_all.parts.parts[1].follows);
  const RepairedSurface body = body_of(repaired, from_all.parts);
  const CurveSkeleton of_body =
      extract_repaired(body, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
  const CharacterRig from_body = rig_body(shape.surface, body, of_body);
  EXPECT_EQ(from_all.rig.names, from_body.rig.names);
  EXPECT_EQ(from_all.rig.parents, from_body.rig.parents);
  EXPECT_LT((from_all.rig.joints - from_body.rig.joints).norm(), 1e-12);
  EXPECT_LT((from_all.rig.weights - from_body.rig.weights).norm(), 1e-5F);
}

TEST_F(RigCharacter, EveryVertexMovesAndFollowersHaveNoJoints) {
  const Rig rig = rig_character(shape.surface, repaired, of_all).rig;
  ASSERT_EQ(rig.weights.rows(), shape.surface.positions.rows());
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    EXPECT_NEAR(rig.weights.row(vertex).sum(), 1, 1e-6) << vertex;
  }
  CharacterOptions all;
  all.parts.follow = 0;
  EXPECT_GT(rig_character(shape.surface, repaired, of_all, all).rig.joints.rows(),
            rig.joints.rows());
}

TEST_F(RigCharacter, AChosenRootMayBeOnAnyPart) {
  CharacterOptions options;
  for (const int node : {0, static_cast<int>(of_all.nodes.rows()) - 1}) {
    options.rig.joints.root = node;
    const CharacterRig made = rig_character(shape.surface, repaired, of_all, options);
    EXPECT_EQ(made.rig.joints.row(0), of_all.nodes.row(node));
    EXPECT_EQ(made.plan.plan, BodyKind::none);
    EXPECT_TRUE(made.parts.all_body());
  }
}

/// A curve that does not say what moves with it is a curve for all.
TEST_F(RigCharacter, WithoutNodesOfVerticesNothingFollows) {
  CurveSkeleton bare = of_all;
  bare.node_of_vertex.resize(0);
  EXPECT_TRUE(rig_character(shape.surface, repaired, bare).parts.all_body());
}

TEST_F(RigCharacter, TheBodysCurveIsPartOfTheWhole) {
  const RigParts parts = find_parts(repaired.surface);
  const CurveSkeleton body = skeleton_of_body(of_all, parts);
  EXPECT_LT(body.nodes.rows(), of_all.nodes.rows());
  EXPECT_EQ(body.nodes.rows() - body.edges.rows(), 1) << "one tree";
  EXPECT_EQ(body.node_of_vertex.size(), body_of(repaired, parts).surface.positions.rows());
  EXPECT_GE(body.node_of_vertex.minCoeff(), 0);
  EXPECT_LT(body.node_of_vertex.maxCoeff(), body.nodes.rows());
}

}  // namespace
}  // namespace curveskel::rig_character_laws
