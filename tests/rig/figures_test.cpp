// Laws of scenes: each figure in one is rigged as if it were alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/repair.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "rig/joints/figure_name.hpp"
#include "rig/pipeline/divided_body.hpp"
#include "rig/pipeline/figures.hpp"
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::figure_laws {
namespace {

using Eigen::RowVector3d;

/// These subjects, each moved along x.
RigSubject scene(const std::vector<std::pair<RigSubject, double>>& subjects) {
  RigSubject all{"scene", {}, {}};
  for (const auto& [subject, x] : subjects) {
    const Eigen::Index vertices = all.surface.positions.rows();
    const Eigen::Index faces = all.surface.triangles.rows();
    const Eigen::Index nodes = all.skeleton.nodes.rows();
    const Eigen::Index edges = all.skeleton.edges.rows();
    const auto extend = [](auto& rows, const auto& more) {
      rows.conservativeResize(rows.rows() + more.rows(), more.cols());
      rows.bottomRows(more.rows()) = more;
    };
    extend(all.surface.positions, subject.surface.positions);
    extend(all.surface.triangles, subject.surface.triangles);
    extend(all.skeleton.nodes, subject.skeleton.nodes);
    extend(all.skeleton.edges, subject.skeleton.edges);
    extend(all.skeleton.radii, subject.skeleton.radii);
    extend(all.skeleton.node_of_vertex, subject.skeleton.node_of_vertex);
    for (Eigen::Index v = vertices; v < all.surface.positions.rows(); ++v) {
      all.surface.positions(v, 0) += x;
      all.skeleton.node_of_vertex[v] += static_cast<int>(nodes);
    }
    for (Eigen::Index k = nodes; k < all.skeleton.nodes.rows(); ++k) all.skeleton.nodes(k, 0) += x;
    for (Eigen::Index f = faces; f < all.surface.triangles.rows(); ++f) {
      all.surface.triangles.row(f).array() += static_cast<int>(vertices);
    }
    for (Eigen::Index e = edges; e < all.skeleton.edges.rows(); ++e) {
      all.skeleton.edges.row(e).array() += static_cast<int>(nodes);
    }
  }
  return all;
}

CharacterRig rig_of(const RigSubject& subject, const CharacterOptions& options = {}) {
  RepairedSurface body;
  body.surface = subject.surface;
  body.vertex_of_input = Eigen::VectorXi::LinSpaced(
      subject.surface.positions.rows(), 0, static_cast<int>(subject.surface.positions.rows()) - 1);
  return rig_body(subject.surface, body, subject.skeleton, options);
}

/// A body of four components and its curves, the last of which no vertex collapsed to; some
/// components are sheets and some touch.
struct Divisible {
  RepairedSurface body;
  CurveSkeleton skeleton;
  Topology counted;

  Divisible() {
    const RigSubject all = scene({{beast(1), 16}, {human(), 0}, {human(), -16}, {beast(1), 40}});
    body.surface = all.surface;
    const auto vertices = static_cast<int>(all.surface.positions.rows());
    body.vertex_of_input.resize(vertices + 5);  // of others, two of them the same, some none
    for (int v = 0; v < vertices + 5; ++v) {
      body.vertex_of_input[v] = v % 7 == 3 ? -1 : v * 5 % vertices;
    }
    skeleton = all.skeleton;
    counted = topology(body.surface);
    for (int c = 0; c < counted.components(); ++c) {
      const int vertex = vertex_of(c);
      const int before = vertex_of(std::max(c - 1, 0));
      body.rims.insert(body.rims.begin(), {vertex, vertex + 2, c % 2 == 0 ? vertex + 1 : before});
      if (c % 2 == 0) body.sheets.insert(body.sheets.begin(), vertex);
      for (const int other : {c + 1, c + 2}) {
        if (other >= counted.components()) continue;
        Contact contact;
        contact.one = {skeleton.node_of_vertex[vertex], {skeleton.node_of_vertex[vertex]}};
        contact.other = {skeleton.node_of_vertex[vertex_of(other)], {}};
        contact.area = 1 + c + 10 * other;
        skeleton.contacts.push_back(contact);
      }
    }
    const int last = counted.components() - 1;
    for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
      if (counted.component_of_vertex[v] == last) skeleton.node_of_vertex[v] = -1;
    }
  }

  [[nodiscard]] int vertex_of(int component) const {
    int v = 0;
    while (counted.component_of_vertex[v] != component) ++v;
    return v;
  }
};

/// Whatever else is there, and in whatever order parts are asked for.
TEST(DividedBodies, HaveThePartsThatAreLeftIfAllElseFollows) {
  const Divisible whole;
  const int components = whole.counted.components();
  ASSERT_GE(components, 4);
  DividedBody divided(whole.body, whole.skeleton, whole.counted);
  for (int chosen = (1 << components) - 1; chosen > 0; --chosen) {
    RigParts parts;
    parts.part_of_vertex = whole.counted.component_of_vertex;
    std::vector<int> members;
    for (int c = 0; c < components; ++c) {
      const bool is_member = (chosen >> c) % 2 != 0;
      parts.parts.push_back({.follows = !is_member});
      if (is_member) members.push_back(c);
    }
    const auto [body, skeleton, inputs] = divided.part_of_file(members);
    EXPECT_EQ(divided.part(members).body.surface.positions, body.surface.positions);
    EXPECT_EQ(divided.nodes(members), nodes_of_body(whole.skeleton, parts));
    const RepairedSurface left = body_of(whole.body, parts);
    const CurveSkeleton curves = skeleton_of_body(whole.skeleton, parts);
    EXPECT_EQ(body.surface.positions, left.surface.positions);
    EXPECT_EQ(body.surface.triangles, left.surface.triangles);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(body.vertex_of_input.size(), Eigen::Index(inputs->size()));
    EXPECT_EQ(body.vertex_of_input, left.vertex_of_input(*inputs));
    EXPECT_EQ((left.vertex_of_input.array() >= 0).count(), body.vertex_of_input.size());
    EXPECT_EQ(body.rims, left.rims);
    EXPECT_EQ(body.sheets, left.sheets);
    EXPECT_EQ(skeleton.nodes, curves.nodes);
    EXPECT_EQ(skeleton.edges, curves.edges);
    EXPECT_EQ(skeleton.radii, curves.radii);
    EXPECT_EQ(skeleton.node_of_vertex, curves.node_of_vertex);
    ASSERT_EQ(skeleton.contacts.size(), curves.contacts.size());
    for (std::size_t k = 0; k < curves.contacts.size(); ++k) {
      EXPECT_EQ(skeleton.contacts[k].one.node, curves.contacts[k].one.node);
      EXPECT_EQ(skeleton.contacts[k].one.tips, curves.contacts[k].one.tips);
      EXPECT_EQ(skeleton.contacts[k].other.node, curves.contacts[k].other.node);
      EXPECT_EQ(skeleton.contacts[k].area, curves.contacts[k].area);
    }
  }
}

/// Of so many vertices and joints, each vertex of its own figure's joints.
RiggedBody small_figure(int vertices, int joints, int inputs, int first_input) {
  RiggedBody made;
  made.body.surface.positions = Positions::Constant(vertices, 3, double(vertices));
  made.body.surface.triangles = Triangles::Constant(1, 3, vertices - 1);
  made.body.vertex_of_input = Eigen::VectorXi::Constant(inputs, -1);
  for (int v = 0; v < vertices; ++v) made.body.vertex_of_input[first_input + v] = v;
  made.skeleton.nodes = Positions::Constant(2, 3, double(joints));
  made.skeleton.edges.resize(1, 2);
  made.skeleton.edges << 0, 1;
  made.skeleton.radii = Eigen::VectorXd::Constant(2, 0.5);
  made.skeleton.node_of_vertex = Eigen::VectorXi::Constant(vertices, 1);
  made.rig.joints = Positions::Constant(joints, 3, double(joints));
  made.rig.parents = Eigen::VectorXi::LinSpaced(joints, -1, joints - 2);
  made.rig.names.assign(std::size_t(joints), "joint");
  made.rig.weights = SkinWeights(vertices, joints);
  for (int v = 0; v < vertices; ++v) made.rig.weights.insert(v, v % joints) = float(vertices);
  return made;
}

/// As figures of a crowd are found.
void keep_own_inputs(RiggedBody& figure) {
  std::vector<int> own;
  for (int input = 0; input < int(figure.body.vertex_of_input.size()); ++input) {
    if (figure.body.vertex_of_input[input] >= 0) own.push_back(input);
  }
  figure.body.vertex_of_input = Eigen::VectorXi(figure.body.vertex_of_input(own));
  figure.inputs = own;
}

TEST(Figures, SideBySideHaveEachItsOwnRowsAndJoints) {
  for (const int count : {1, 2, 9}) {
    std::vector<RiggedBody> figures;
    figures.reserve(std::size_t(count));
    const int inputs = count * (count + 5);
    for (int k = 0; k < count; ++k) {
      figures.push_back(small_figure(4 + k, 2 + k % 3, inputs, k * (count + 5)));
      if (k % 2 == 1) keep_own_inputs(figures.back());
    }
    if (count == 9) figures[4].rig.readable.assign(figures[4].rig.names.size(), "Joint");
    const RiggedBody all = side_by_side(figures, inputs);
    const Eigen::MatrixXf weights = all.rig.weights;
    EXPECT_EQ(all.rig.readable.size(), count == 9 ? all.rig.names.size() : 0U);
    int vertex = 0;
    int joint = 0;
    float sum = 0;
    for (int k = 0; k < count; ++k) {
      const auto vertices = static_cast<int>(figures[std::size_t(k)].rig.weights.rows());
      const auto joints = static_cast<int>(figures[std::size_t(k)].rig.weights.cols());
      const Eigen::MatrixXf own = figures[std::size_t(k)].rig.weights;
      EXPECT_EQ(weights.block(vertex, joint, vertices, joints), own);
      EXPECT_EQ(all.rig.joints(joint, 0), joints);
      EXPECT_EQ(all.rig.parents[joint], -1);
      EXPECT_EQ(all.rig.parents[joint + 1], joint);
      EXPECT_EQ(all.rig.names[std::size_t(joint)], figure_prefix(std::size_t(k)) + "joint");
      EXPECT_EQ(all.body.surface.triangles(k, 2), vertex + vertices - 1);
      EXPECT_EQ(all.body.vertex_of_input[k * (count + 5) + 1], vertex + 1);
      EXPECT_EQ(all.body.vertex_of_input[k * (count + 5) + vertices], -1);
      EXPECT_EQ(all.skeleton.edges(k, 1), 2 * k + 1);
      EXPECT_EQ(all.skeleton.node_of_vertex[vertex], 2 * k + 1);
      vertex += vertices;
      joint += joints;
      sum += own.sum();
    }
    EXPECT_EQ(weights.rows(), vertex);
    EXPECT_EQ(weights.cols(), joint);
    EXPECT_EQ(weights.sum(), sum);
  }
}

/// There may be a thousand of them to look at.
TEST(Figures, AreLookedForUntilSomebodyStopsThat) {
  const RigSubject both = scene({{beast(1), 16}, {human(), 0}});
  RepairedSurface body;
  body.surface = both.surface;
  std::stop_source stopped;
  EXPECT_FALSE(find_figures(body, both.skeleton, {}, stopped.get_token()).empty());
  stopped.request_stop();
  EXPECT_THROW((void)find_figures(body, both.skeleton, {}, stopped.get_token()), Cancelled);
}

/// Each figure of a scene is rigged as if it were alone.
TEST(Figures, OfASceneAreRiggedEachByItsPlan) {
  constexpr double aside = 16;
  const CharacterRig one = rig_of(human());
  const CharacterRig other = rig_of(beast(1));
  const CharacterRig both = rig_of(scene({{beast(1), aside}, {human(), 0}}));
  EXPECT_EQ(both.plan.plan, BodyKind::humanoid);
  ASSERT_EQ(both.other_plans.size(), 1U);
  EXPECT_EQ(both.other_plans[0].plan, BodyKind::quadruped);
  const std::size_t first = one.rig.names.size();
  ASSERT_EQ(both.rig.names.size(), first + other.rig.names.size());
  const Eigen::Index beast_vertices = other.rig.weights.rows();
  for (std::size_t k = 0; k < both.rig.names.size(); ++k) {
    const bool is_one = k < first;
    const Rig& alone = is_one ? one.rig : other.rig;
    const std::size_t same = is_one ? k : k - first;
    EXPECT_EQ(both.rig.names[k], (is_one ? "" : "figure2_") + alone.names[same]);
    const std::string& role = alone.roles[same];
    EXPECT_EQ(both.rig.roles[k], is_one || role.empty() ? role : "figure2_" + role);
    const auto row = static_cast<Eigen::Index>(k);
    const auto alone_row = static_cast<Eigen::Index>(same);
    const int parent = alone.parents[alone_row];
    EXPECT_EQ(both.rig.parents[row], parent < 0 || is_one ? parent : parent + int(first));
    const RowVector3d shift(is_one ? 0 : aside, 0, 0);
    EXPECT_LT((both.rig.joints.row(row) - alone.joints.row(alone_row) - shift).norm(), 1e-9);
  }
  for (Eigen::Index v = 0; v < both.rig.weights.rows(); ++v) {
    const bool is_one = v >= beast_vertices;
    const Rig& alone = is_one ? one.rig : other.rig;
    for (SkinWeights::InnerIterator it(both.rig.weights, v); it; ++it) {
      const Eigen::Index joint = is_one ? it.col() : it.col() - static_cast<Eigen::Index>(first);
      ASSERT_GE(joint, 0);
      ASSERT_NEAR(it.value(), alone.weights.coeff(is_one ? v - beast_vertices : v, joint), 1e-5F);
    }
  }
}

/// Of a scene with two humans, without "figure2_".
std::vector<std::string> names_of_second(const Rig& both, std::size_t first_count) {
  std::vector<std::string> names;
  for (std::size_t k = first_count; k < both.names.size(); ++k) {
    EXPECT_TRUE(both.names[k].starts_with("figure2_")) << both.names[k];
    names.push_back(both.names[k].substr(8));
  }
  return names;
}

TEST(Figures, EachKeepsTheJointsThatTheBudgetLeavesItAlone) {
  constexpr double aside = 30;
  const RigSubject alone = human_with_hands(1);
  const RigSubject two = scene({{alone, 0}, {alone, aside}});
  const CharacterRig one = rig_of(alone);
  const CharacterRig both = rig_of(two);
  ASSERT_EQ(both.other_plans.size(), 1U);
  const auto count = static_cast<int>(one.rig.names.size());
  for (const int budget : {count, count - 6, 40, 30, 20, 5}) {
    SCOPED_TRACE(budget);
    const CharacterRig few = within_budget(one, alone.surface, budget);
    const CharacterRig few_both = within_budget(both, two.surface, budget);
    const std::size_t left = few.rig.names.size();
    ASSERT_EQ(few_both.rig.names.size(), 2 * left);
    EXPECT_EQ(few_both.joints_over_budget, std::max(0, static_cast<int>(left) - budget));
    EXPECT_EQ(names_of_second(few_both.rig, left), few.rig.names);
    ASSERT_EQ(few_both.other_plans[0].joints.size(), few.plan.joints.size());
    for (std::size_t k = 0; k < few.plan.joints.size(); ++k) {
      EXPECT_EQ(few_both.other_plans[0].joints[k].role, few.plan.joints[k].role);
      EXPECT_EQ(few_both.other_plans[0].joints[k].parent, few.plan.joints[k].parent);
    }
  }
}

TEST(Figures, AllHumansTakeTheTPose) {
  RigSubject alone = human();
  for (Positions* const points : {&alone.surface.positions, &alone.skeleton.nodes}) {
    for (auto p : points->rowwise()) {
      const double out = std::abs(p.x()) - 2;
      if (p.y() > 12 && out > 0) p.y() -= 0.8 * out;
    }
  }
  CharacterRig one = rig_of(alone);
  CharacterRig all = rig_of(scene({{alone, 0}, {alone, 30}, {beast(1), 60}}));
  ASSERT_EQ(all.other_plans.size(), 2U);
  rest_in_t_pose(one.rig, one.plan);
  rest_in_t_pose(all.rig, all.plan, all.other_plans);
  const std::size_t count = one.rig.names.size();
  double most = 0;
  for (std::size_t k = 0; k < all.rig.turns.size(); ++k) {
    const Eigen::Quaterniond still = Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond wanted = k < 2 * count ? one.rig.turns[k % count] : still;
    EXPECT_LT(all.rig.turns[k].angularDistance(wanted), 1e-6) << all.rig.names[k];
    most = std::max(most, wanted.angularDistance(still));
  }
  EXPECT_GT(most, 0.1);
}

TEST(Figures, AreNotMadeOfThings) {
  const CharacterRig with_tree = rig_of(scene({{human(), 0}, {tree(), 30}}));
  EXPECT_TRUE(with_tree.other_plans.empty());
  const CharacterRig three = rig_of(scene({{human(), 0}, {tree(), 30}, {human(), 60}}));
  EXPECT_EQ(three.other_plans.size(), 1U);
  for (Eigen::Index v = 0; v < three.rig.weights.rows(); ++v) {
    ASSERT_NEAR(three.rig.weights.row(v).sum(), 1, 1e-5F) << "something moves the tree, too";
  }
}

std::vector<std::string> roles_in(const BodyPlan& plan) {
  std::vector<std::string> roles;
  for (const PlannedJoint& joint : plan.joints) roles.push_back(joint.role);
  return roles;
}

TEST(Figures, AreThereIfAPlanIsAskedFor) {
  CharacterOptions options;
  options.plan.plan = BodyKind::humanoid;
  const CharacterRig two = rig_of(scene({{human(), 0}, {human(), 30}}), options);
  EXPECT_EQ(two.plan.plan, BodyKind::humanoid);
  ASSERT_EQ(two.other_plans.size(), 1U);
  EXPECT_EQ(two.other_plans[0].plan, BodyKind::humanoid);
  const CharacterRig one = rig_of(scene({{human(), 0}, {beast(1), 30}}), options);
  EXPECT_EQ(one.plan.plan, BodyKind::humanoid);
  EXPECT_EQ(roles_in(one.plan), roles_in(rig_of(human()).plan));
}

/// A box as wide as this below a subject, its upper side at this height; its curve is a line.
RigSubject slab(double width, double top) {
  RigSubject subject{"slab", shapes::box({width, 1, width}, 4).surface, {}};
  subject.surface.positions.col(1).array() += top - 0.5;
  subject.skeleton.nodes.resize(2, 3);
  subject.skeleton.nodes << -width / 2, top - 0.5, 0, width / 2, top - 0.5, 0;
  subject.skeleton.edges.resize(1, 2);
  subject.skeleton.edges << 0, 1;
  subject.skeleton.radii.setConstant(2, 0.5);
  const Positions& positions = subject.surface.positions;
  subject.skeleton.node_of_vertex = (positions.col(0).array() > 0).cast<int>();
  return subject;
}

/// The scene is not made of tubes, the figure is; nothing hangs from it that is the ground.
TEST(Figures, StandOnSlabs) {
  const std::vector<std::string> alone = roles_in(rig_of(human()).plan);
  const double feet = human().surface.positions.col(1).minCoeff();
  for (const double gap : {-0.1, 0.0, 0.5}) {
    SCOPED_TRACE(gap);
    CharacterOptions options;
    options.plan.made_of_tubes = false;
    const CharacterRig found = rig_of(scene({{human(), 0}, {slab(60, feet - gap), 0}}), options);
    EXPECT_EQ(found.plan.plan, BodyKind::humanoid) << found.plan.reason;
    EXPECT_EQ(roles_in(found.plan), alone);
    EXPECT_EQ((found.rig.parents.array() < 0).count(), 2);
  }
}

/// Limbs with gaps between them and the trunk: no two boxes of components meet.
std::vector<std::pair<RigSubject, double>> doll_of_parts() {
  BodyCurve trunk;
  const int hips = trunk.add({0, 10, 0}, 1.4);
  const int chest = trunk.add({0, 15, 0}, 1.5, hips);
  trunk.add({0, 18.6, 0}, 1.3, trunk.add({0, 16.8, 0}, 0.6, chest));
  std::vector<std::pair<RigSubject, double>> parts{{subject_of("trunk", trunk), 0}};
  for (const double side : {1.0, -1.0}) {
    BodyCurve arm;
    arm.add({side * 8.5, 15, 0}, 0.5, arm.add({side * 2.2, 15, 0}, 0.5));
    BodyCurve leg;
    leg.add({side * 1.6, 0.5, 2}, 0.6,
            leg.add({side * 1.6, 0.6, 0}, 0.6, leg.add({side * 1.6, 7.9, 0}, 0.6)));
    parts.emplace_back(subject_of("arm", arm), 0);
    parts.emplace_back(subject_of("leg", leg), 0);
  }
  return parts;
}

TEST(Figures, OfPartsStandOnSlabs) {
  std::vector<std::pair<RigSubject, double>> parts = doll_of_parts();
  const CharacterRig alone = rig_of(scene(parts));
  ASSERT_EQ(alone.plan.plan, BodyKind::humanoid) << alone.plan.reason;
  parts.emplace_back(slab(60, 0), 0);
  const CharacterRig found = rig_of(scene(parts));
  EXPECT_EQ(found.plan.plan, BodyKind::humanoid) << found.plan.reason;
  EXPECT_EQ(roles_in(found.plan), roles_in(alone.plan));
}

/// A tree that is nearer to one of two humans is no part of the human's plan.
TEST(Figures, AreAsIfNothingStoodBesideThem) {
  const CharacterRig alone = rig_of(human());
  const CharacterRig found = rig_of(scene({{human(), 0}, {tree(), 30}, {human(), 62}}));
  ASSERT_EQ(found.other_plans.size(), 1U);
  EXPECT_EQ(roles_in(found.plan), roles_in(alone.plan));
  EXPECT_EQ(roles_in(found.other_plans[0]), roles_in(alone.plan));
}

}  // namespace
}  // namespace curveskel::figure_laws
