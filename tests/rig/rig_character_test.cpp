// Laws of the rig of all that is in a file, from the curve of all of it or of the body alone.
#include <curveskel/rig_character.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_polygons.hpp>
#include "meshes/shapes.hpp"
#include "tests/real_surfaces.hpp"
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

TEST_F(RigCharacter, IsTheSameFromASkeletonThatIsGiven) {
  RigSources given;
  given.skeleton = of_all;
  given.skeleton->node_of_vertex =
      repaired.vertex_of_input.unaryExpr([&](int v) { return of_all.node_of_vertex[v]; });
  const PolygonSoup soup = soup_of(shape.surface);
  const CharacterRig made = rig_polygons(soup).character;
  const CharacterRig same = rig_polygons(soup, given).character;
  EXPECT_FALSE(same.parts.all_body());
  EXPECT_EQ(same.rig.names, made.rig.names);
  EXPECT_EQ(same.rig.parents, made.rig.parents);
  EXPECT_LT((same.rig.joints - made.rig.joints).norm(), 1e-9);

  // Whoever draws curves into the buttons alone, or chooses a root, means these nodes.
  RigPolygonsOptions rooted;
  rooted.character.rig.joints.root = 0;
  EXPECT_TRUE(rig_polygons(soup, given, rooted).character.parts.all_body());
  EXPECT_TRUE(rig_polygons(soup, {}, rooted).character.parts.all_body());
  const RigParts& parts = same.parts;
  for (int& node : given.skeleton->node_of_vertex) {
    const auto v = &node - given.skeleton->node_of_vertex.data();
    const int part = parts.part_of_vertex[repaired.vertex_of_input[v]];
    if (!parts.parts[static_cast<std::size_t>(part)].follows) node = -1;
  }
  CurveSkeleton& buttons = *given.skeleton;
  buttons.edges.resize(0, 2);
  std::map<int, int> number;
  for (int& node : buttons.node_of_vertex) {
    if (node >= 0) node = number.emplace(node, static_cast<int>(number.size())).first->second;
  }
  CurveSkeleton kept = buttons;
  kept.nodes.resize(static_cast<Eigen::Index>(number.size()), 3);
  kept.radii.resize(kept.nodes.rows());
  kept.lives.resize(0);
  kept.contacts.clear();
  for (const auto& [before, now] : number) {
    kept.nodes.row(now) = of_all.nodes.row(before);
    kept.radii[now] = of_all.radii[before];
  }
  given.skeleton = kept;
  EXPECT_TRUE(rig_polygons(soup, given).character.parts.all_body());
}

TEST_F(RigCharacter, IsTheSameWhateverTheCacheHolds) {
  const PolygonSoup soup = soup_of(shape.surface);
  ExtractionCache cache;
  (void)extract_repaired(repaired, {}, {}, {}, cache);
  for (const double detail : {0.5, 0.8, 0.2}) {
    for (const double follow : {1.0, 0.0}) {
      SCOPED_TRACE(testing::Message() << "detail " << detail << ", follow " << follow);
      RigPolygonsOptions options;
      options.extract.embed.detail = detail;
      options.character.parts.follow = follow;
      const PolygonsRig fresh = rig_polygons(soup, {}, options);
      const PolygonsRig cached = rig_polygons(soup, {}, options, {}, cache);
      EXPECT_EQ(cached.character.rig.names, fresh.character.rig.names);
      EXPECT_EQ(cached.character.rig.joints, fresh.character.rig.joints);
      EXPECT_EQ((cached.character.rig.weights - fresh.character.rig.weights).norm(), 0);
      EXPECT_EQ(cached.vertex_of_input, repaired.vertex_of_input);
    }
  }
}

/// The mean of two hands in a pose lies beside both.
TEST(RealCharacters, OfOnePieceHaveTheirJointsWithinThem) {
  for (const std::string& file : present_among({"humanoid-10k.ply", "spot-3k.obj"})) {
    const PolygonSoup soup = read_polygons(*real_surface(file), {});
    const PolygonsRig found = rig_polygons(soup);
    const SurfaceTree tree(repair(soup).surface);
    const Rig& rig = found.character.rig;
    for (std::size_t joint = 0; joint < rig.names.size(); ++joint) {
      const auto row = static_cast<Eigen::Index>(joint);
      EXPECT_TRUE(tree.inside(rig.joints.row(row).transpose())) << file << " " << rig.names[joint];
    }
  }
}

/// Limbs of several lengths on a trunk: a shorter one has a shorter life.
Shape limbs() {
  CurveSkeleton graph;
  graph.nodes.resize(8, 3);
  graph.nodes << 0, 0, 0, 6, 0, 0, -5, 1, 0, 11, 1, 0, 0, -4, 2, 0, -2, -1.6, 6, -5, 2, 6, 1, -2.4;
  graph.edges.resize(7, 2);
  graph.edges << 0, 1, 0, 2, 1, 3, 0, 4, 0, 5, 1, 6, 1, 7;
  graph.radii.resize(8);
  graph.radii << 1, 1, 0.8, 0.7, 0.5, 0.5, 0.5, 0.6;
  return shapes::tube_union("limbs", graph);
}

/// All that stays has its name, its place and the nearest ancestor that stays as its parent; every
/// vertex moves.
void expect_same_but_fewer(const Rig& few, const Rig& all) {
  const auto place_of = [](const std::string& name, const Rig& rig) {
    return std::find(rig.names.begin(), rig.names.end(), name) - rig.names.begin();
  };
  const auto parent_of = [](Eigen::Index joint, const Rig& rig) {
    const int parent = rig.parents[joint];
    return parent < 0 ? std::string() : rig.names[static_cast<std::size_t>(parent)];
  };
  for (std::size_t joint = 0; joint < few.names.size(); ++joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    const Eigen::Index same = place_of(few.names[joint], all);
    ASSERT_LT(same, all.joints.rows());
    EXPECT_EQ(few.joints.row(row), all.joints.row(same));
    ASSERT_LT(few.parents[row], row);
    int ancestor = all.parents[same];
    const auto stays = [&](int at) {
      return std::find(few.names.begin(), few.names.end(), all.names[idx(at)]) != few.names.end();
    };
    while (ancestor >= 0 && !stays(ancestor)) ancestor = all.parents[ancestor];
    EXPECT_EQ(parent_of(row, few), ancestor < 0 ? std::string() : all.names[idx(ancestor)]);
  }
  for (Eigen::Index vertex = 0; vertex < few.weights.rows(); ++vertex) {
    ASSERT_NEAR(few.weights.row(vertex).sum(), 1, 1e-5);
  }
}

TEST(CharacterLevels, JointsOfACoarserLevelAreTheSameButFewer) {
  const Shape shape = limbs();
  const RepairedSurface repaired = repair(soup_of(shape.surface));
  const CurveSkeleton skeleton =
      extract_repaired(repaired, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
  const CharacterRig all = rig_character(shape.surface, repaired, skeleton);
  std::size_t before = all.rig.names.size();
  for (const double limit : {0.0, 1.5, 3.0, 4.5, 6.0, 100.0}) {
    SCOPED_TRACE(limit);
    const CharacterRig level = level_of_character(all, skeleton, limit);
    ASSERT_LE(level.rig.names.size(), before);
    before = level.rig.names.size();
    expect_same_but_fewer(level.rig, all.rig);
  }
  EXPECT_LT(before, all.rig.names.size());
  EXPECT_EQ(level_of_character(all, skeleton, 0).rig.names, all.rig.names);
}

int count_idle(const Rig& rig) {
  const Eigen::RowVectorXf moved =
      Eigen::RowVectorXf::Ones(rig.weights.rows()) * Eigen::MatrixXf(rig.weights);
  return static_cast<int>((moved.array() == 0).count());
}

TEST(JointBudget, LeavesTheSameJointsButFewerAndWhatMovesNothingGoesFirst) {
  const Shape shape = limbs();
  const RepairedSurface repaired = repair(soup_of(shape.surface));
  const CurveSkeleton skeleton =
      extract_repaired(repaired, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
  CharacterOptions options;
  options.plan.plan = BodyKind::none;
  const CharacterRig all = rig_character(shape.surface, repaired, skeleton, options);
  const auto count = static_cast<int>(all.rig.joints.rows());
  const int idle = count_idle(all.rig);
  ASSERT_GT(idle, 2);
  ASSERT_GT(count, idle + 4);
  for (int budget = count + 1; budget > 0; --budget) {
    SCOPED_TRACE(budget);
    const CharacterRig few = within_budget(all, shape.surface, budget);
    // Of two that go together both go.
    EXPECT_LE(few.rig.joints.rows(), budget);
    EXPECT_GE(few.rig.joints.rows(), std::min(budget - 1, count));
    EXPECT_EQ(few.joints_left_out, count - few.rig.joints.rows());
    EXPECT_EQ(count_idle(few.rig), std::max(0, idle - few.joints_left_out));
    expect_same_but_fewer(few.rig, all.rig);
  }
  EXPECT_EQ(within_budget(all, shape.surface, 0).rig.names, all.rig.names);
  options.joint_budget = count - 1;
  EXPECT_EQ(rig_character(shape.surface, repaired, skeleton, options).rig.names,
            within_budget(all, shape.surface, count - 1).rig.names);
}

/// A rig with a joint at each node of a star whose tips have these lives.
CharacterRig rig_on_star(const std::vector<double>& lives, const std::vector<std::string>& names,
                         const std::vector<std::string>& roles, CurveSkeleton& skeleton) {
  const auto arms = static_cast<int>(lives.size());
  skeleton = shapes::star(arms, 1, 0.1);
  skeleton.lives.setZero(arms + 1);
  CharacterRig character;
  character.rig.joints = skeleton.nodes;
  character.rig.parents.setZero(arms + 1);
  character.rig.parents[0] = -1;
  character.rig.names = {"hand.L"};
  character.rig.roles = {"leftHand"};
  for (int arm = 0; arm < arms; ++arm) {
    const auto k = static_cast<std::size_t>(arm);
    skeleton.lives[arm + 1] = lives[k];
    character.rig.names.push_back(names[k]);
    character.rig.roles.push_back(roles[k]);
  }
  character.rig.weights.resize(1, arms + 1);
  character.rig.weights.insert(0, 0) = 1;
  return character;
}

std::size_t joints_at(const CharacterRig& character, const CurveSkeleton& skeleton, double limit) {
  return level_of_character(character, skeleton, limit).rig.names.size();
}

/// The forearm and the longest finger, for ever, are not asked about.
TEST(CharacterLevels, ThumbAndFingersGoTogether) {
  CurveSkeleton skeleton;
  const CharacterRig hand = rig_on_star(
      {1, 5, 6, 20, 30}, {"thumb.L", "index.L", "middle.L", "arm", "ring.L"},
      {"leftThumbMetacarpal", "leftIndexProximal", "leftMiddleProximal", "", "leftRingProximal"},
      skeleton);
  EXPECT_EQ(joints_at(hand, skeleton, 4), 6U);
  EXPECT_EQ(joints_at(hand, skeleton, 5.5), 6U);
  EXPECT_EQ(joints_at(hand, skeleton, 7), 2U);
}

TEST(CharacterLevels, MirrorImagesGoTogether) {
  CurveSkeleton skeleton;
  const CharacterRig head =
      rig_on_star({1, 3, 20, 30}, {"ear.L", "ear.R", "neck", "snout"}, {"", "", "", ""}, skeleton);
  EXPECT_EQ(joints_at(head, skeleton, 2), 5U);
  EXPECT_EQ(joints_at(head, skeleton, 4), 3U);
}

TEST(JointBudget, MirrorImagesGoTogetherAndThoseWithRolesLast) {
  CurveSkeleton skeleton;
  const CharacterRig head = rig_on_star({1, 3, 20, 30}, {"eye.L", "eye.R", "ear", "snout"},
                                        {"leftEye", "rightEye", "", ""}, skeleton);
  Surface point;
  point.positions.setZero(1, 3);
  const auto left = [&](int budget) { return within_budget(head, point, budget).rig.names.size(); };
  EXPECT_EQ(left(4), 4U);
  EXPECT_EQ(left(3), 3U);
  EXPECT_EQ(left(2), 1U);
  EXPECT_EQ(within_budget(head, point, 3).rig.names[1], "eye.L");  // the ear and the snout went
}

TEST(JointBudget, DigitsOfBothHandsGoByTheirPlaces) {
  CurveSkeleton skeleton;
  CharacterRig hand = rig_on_star(
      {1, 5, 6, 20, 30, 31}, {"thumb.L", "index.L", "index_2.L", "index.R", "eye.L", "index_2.R"},
      {"leftThumbMetacarpal", "leftIndexProximal", "leftIndexIntermediate", "rightIndexProximal",
       "leftEye", "rightIndexIntermediate"},
      skeleton);
  hand.rig.parents[3] = 2;
  hand.rig.parents[6] = 4;
  Surface point;
  point.positions.setZero(1, 3);
  const auto left = [&](int budget) { return within_budget(hand, point, budget).rig.names; };
  using Names = std::vector<std::string>;
  EXPECT_EQ(left(6), (Names{"hand.L", "thumb.L", "index.L", "index_2.L", "index.R", "index_2.R"}));
  EXPECT_EQ(left(5), (Names{"hand.L", "thumb.L", "index.L", "index.R"}));
  EXPECT_EQ(left(3), Names{"hand.L"});
}

/// A snake is no stump for having many joints.
TEST(JointBudget, LongLimbsKeepTheirReachAndTheirShares) {
  constexpr int count = 65;
  constexpr Eigen::Index vertices = 3 * Eigen::Index{count};
  CharacterRig snake;
  snake.rig.joints.setZero(count, 3);
  snake.rig.joints.col(0) = Eigen::VectorXd::LinSpaced(count, 0, count - 1);
  snake.rig.parents = Eigen::VectorXi::LinSpaced(count, -1, count - 2);
  snake.rig.roles.assign(count, "");
  Surface given;
  given.positions.resize(vertices, 3);
  given.triangles.resize(count, 3);
  snake.rig.weights.resize(vertices, count);
  for (int joint = 0; joint < count; ++joint) {
    snake.rig.names.push_back("spine" + std::to_string(joint));
    given.triangles.row(joint) << 3 * joint, 3 * joint + 1, 3 * joint + 2;
    for (int k = 0; k < 3; ++k) {
      given.positions.row(3 * joint + k) << joint, k == 1 ? 1 : 0, k == 2 ? 1 : 0;
      snake.rig.weights.insert(3 * joint + k, joint) = 1;
    }
  }
  for (const int budget : {2, 5, 8, 16, 33, 50}) {
    const Rig few = within_budget(snake, given, budget).rig;
    ASSERT_EQ(few.joints.rows(), budget);
    const double fair_share = double(count) / budget;
    EXPECT_GT(few.joints.col(0).maxCoeff(), count - 1 - 2 * fair_share) << budget;
    const Eigen::RowVectorXf moved =
        Eigen::RowVectorXf::Ones(vertices) * Eigen::MatrixXf(few.weights);
    EXPECT_LE(moved.maxCoeff() / 3, 2 * fair_share + 1) << budget;
    expect_same_but_fewer(few, snake.rig);
  }
}

TEST(JointBudget, NoFewerThanNone) { EXPECT_THROW((void)within_budget({}, {}, -1), Error); }

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
