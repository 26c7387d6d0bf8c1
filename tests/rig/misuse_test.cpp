// Values that were moved from, choices that there are not, numbers that are none: each public
// function that takes them answers by an Error, or by what its header says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel.hpp>
#include "tests/rig/misuse_subjects.hpp"

namespace curveskel::misuse_laws {
namespace {

/// Whoever calls it goes on with what is left.
template <typename T>
T taken_from(T& value) {
  return std::move(value);
}

using namespace misuse;

TEST(Misuse, ATreeThatWasMovedFromSaysSo) {
  SurfaceTree tree(torus());
  const SurfaceTree moved_to = taken_from(tree);
  const Eigen::Vector3d at(3, 0, 0);
  const Eigen::Vector3d up(0, 0, 1);
  const std::vector<std::function<void(const SurfaceTree&)>> queries{
      [&](const SurfaceTree& t) { (void)t.in_frame(Eigen::Matrix3d::Identity(), at, 1); },
      [&](const SurfaceTree& t) { (void)t.nearest(at); },
      [&](const SurfaceTree& t) { (void)t.ray(at, up); },
      [&](const SurfaceTree& t) {
        std::array<double, 1> distance{};
        t.rays_in_plane(at, Eigen::Vector3d::UnitX(), std::span(&up, 1), infinity, distance);
      },
      [&](const SurfaceTree& t) { (void)t.near_plane(at, up); },
      [&](const SurfaceTree& t) { (void)t.comes_near(at, at + 0.1 * up, 0.1); },
      [&](const SurfaceTree& t) { (void)t.inside(at); },
      [&](const SurfaceTree& t) { (void)t.inscribed_radius(at); },
      [&](const SurfaceTree& t) {
        (void)t.inscribed_radius(at, {at, 1});
      },
      [&](const SurfaceTree& t) {
        (void)t.inscribed_ball({4, 0, 0}, {-1, 0, 0});
      },
      [&](const SurfaceTree& t) { (void)inscribed_balls(torus(), t, 1); },
      [&](const SurfaceTree& t) { (void)move_node(a_skeleton(), 0, at, &t); },
      [&](const SurfaceTree& t) {
        (void)findings(t, 8, a_skeleton(), CertificateOptions{}, Monitor{});
      }};
  for (const auto& query : queries) {
    EXPECT_NO_THROW(query(moved_to));
    expect_error(Fault::usage, "moved from", [&] { query(tree); });
  }
  tree = SurfaceTree(torus());
  EXPECT_EQ(tree.nearest(at).distance, moved_to.nearest(at).distance);
}

TEST(Misuse, ATreeRefusesFramesAndDirectionsThatDoNotFit) {
  const SurfaceTree tree(torus());
  const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d here(0, 0, 0);
  for (const double scale : {0.0, -1.0, infinity, not_a_number}) {
    expect_error(Fault::usage, "scale", [&] { (void)tree.in_frame(straight, here, scale); });
  }
  expect_error(Fault::usage, "finite", [&] {
    (void)tree.in_frame(straight, {0, not_a_number, 0}, 1);
  });
  const std::vector<Eigen::Vector3d> two{{0, 0, 1}, {0, 1, 0}};
  std::vector<double> one(1);
  expect_error(Fault::usage, "2 directions", [&] {
    tree.rays_in_plane({3, 0, 0}, Eigen::Vector3d::UnitX(), two, infinity, one);
  });
}

TEST(Misuse, ASolverThatWasMovedFromSaysSo) {
  SparseMatrix one(1, 1);
  one.insert(0, 0) = 2;
  const Positions right = Positions::Ones(1, 3);
  LeastSquares solver(Solver::cholesky);
  LeastSquares moved_to = taken_from(solver);
  EXPECT_DOUBLE_EQ(moved_to.solve_definite(one, right).x(0, 0), 0.5);
  expect_error(Fault::usage, "moved from", [&] { (void)solver.solver(); });
  expect_error(Fault::usage, "moved from", [&] { (void)solver.solve(one, right); });
  expect_error(Fault::usage, "moved from", [&] { (void)solver.solve_definite(one, right); });
  solver = LeastSquares(Solver::sparse_qr);
  EXPECT_EQ(solver.solver(), Solver::sparse_qr);
}

TEST(Misuse, ChoicesThatThereAreNotAreRefusedByName) {
  constexpr int beyond = 77;
  const auto refused = [](const std::string& option, const std::function<void()>& call) {
    expect_error(Fault::usage, option + " is " + std::to_string(beyond), call);
  };
  refused("SolverOptions::solver", [] { (void)LeastSquares(static_cast<Solver>(beyond)); });
  SurgeryOptions surgery_options;
  surgery_options.method = static_cast<SurgeryMethod>(beyond);
  refused("SurgeryOptions::method", [&] { require_valid(surgery_options); });
  EmbedOptions embed_options;
  embed_options.method = static_cast<EmbedMethod>(beyond);
  refused("EmbedOptions::method", [&] { require_valid(embed_options); });
  CharacterOptions character;
  character.plan.plan = static_cast<BodyKind>(beyond);
  refused("PlanOptions::plan", [&] { (void)find_plan(torus(), a_skeleton(), character.plan); });
  refused("PlanOptions::plan",
          [&] { (void)rig_body(torus(), as_if_repaired(), a_skeleton(), character); });
  for (Direction PlanOptions::*direction : {&PlanOptions::up, &PlanOptions::front}) {
    PlanOptions plan;
    plan.*direction = static_cast<Direction>(beyond);
    refused(direction == &PlanOptions::up ? "PlanOptions::up" : "PlanOptions::front",
            [&] { (void)find_plan(torus(), a_skeleton(), plan); });
  }
  CharacterOptions named;
  named.names = static_cast<NameStyle>(beyond);
  refused("CharacterOptions::names",
          [&] { (void)rig_character(torus(), as_if_repaired(), a_skeleton(), named); });
  refused("use_preset::preset", [] {
    RepairOptions repairs;
    ExtractOptions extraction;
    use_preset(static_cast<Preset>(beyond), repairs, extraction);
  });
  const Rig rig = make_rig(torus(), a_skeleton());
  refused("format_rig::format",
          [&] { (void)format_rig(torus(), rig, static_cast<RigFormat>(beyond), "torus", ""); });
  refused("EditOptions::format", [&] {
    EditOptions edit;
    edit.format = static_cast<RigFormat>(beyond);
    (void)format_rig_into("torus.glb", rig, edit);
  });
  refused("EditOptions::old_rig", [&] {
    EditOptions edit;
    edit.old_rig = static_cast<OldRig>(beyond);
    (void)format_rig_into("torus.glb", rig, edit);
  });
  refused("ExportOptions::pose", [&] {
    ExportOptions exported;
    exported.pose = static_cast<RestPose>(beyond);
    (void)rig_for_export(rig, {}, torus(), exported);
  });
  refused("name_roles::style", [&] {
    Rig changed = rig;
    name_roles(changed, {}, static_cast<NameStyle>(beyond));
  });
  refused("assign_role::style", [&] {
    Rig changed = rig;
    BodyPlan plan;
    assign_role(changed, plan, 0, "head", static_cast<NameStyle>(beyond));
  });
  refused("merge_nodes::place",
          [] { (void)merge_nodes(a_skeleton(), 0, 1, static_cast<MergePlace>(beyond)); });
  refused("format_labelled_surface::format", [] {
    const PolygonSoup soup = soup_of(torus());
    const BranchLabels labels{Eigen::VectorXi::Zero(vertices()),
                              Eigen::VectorXi::Zero(torus().triangles.rows())};
    (void)format_labelled_surface(soup, labels, static_cast<LabelledFormat>(beyond));
  });
}

TEST(Misuse, NamesOfTriesEnd) {
  std::vector<Try> history(3);
  history[0].name = try_faired;
  for (const int number : {1, 2}) {
    history[static_cast<std::size_t>(number)].name = try_gentler;
    history[static_cast<std::size_t>(number)].part_of = number - 1;
  }
  EXPECT_EQ(full_name(history, -1), "");
  EXPECT_EQ(full_name(history, 1), "faired, gentler contraction");
  expect_error(Fault::input, "try 3", [&] { (void)full_name(history, 3); });
  history[0].part_of = 2;
  expect_error(Fault::input, "try 2", [&] { (void)full_name(history, 1); });
  history[0].part_of = 0;
  expect_error(Fault::input, "try 0", [&] { (void)full_name(history, 0); });
}

TEST(Misuse, TablesHaveTerritoriesOfTheirOwnBranches) {
  const BranchTerritories own = branch_territories(torus(), a_skeleton());
  const auto with = [](const BranchTerritories& territories) {
    SkeletonContext context;
    context.territories = &territories;
    return context;
  };
  const auto count = branches(a_skeleton()).size();
  EXPECT_NO_THROW((void)format_skeleton(a_skeleton(), SkeletonFormat::csv, with(own)));
  for (const std::size_t other : {std::size_t{0}, count - 1, count + 1}) {
    BranchTerritories spoilt = own;
    spoilt.areas.resize(other);
    expect_error(Fault::input, "territories",
                 [&] { (void)format_skeleton(a_skeleton(), SkeletonFormat::csv, with(spoilt)); });
    spoilt = own;
    spoilt.volumes.resize(other);
    expect_error(Fault::input, "territories",
                 [&] { (void)format_skeleton(a_skeleton(), SkeletonFormat::csv, with(spoilt)); });
  }
}

TEST(Misuse, PicturesNeedPlaces) {
  for (const double place : {not_a_number, infinity, 1e200}) {
    Surface surface = torus();
    surface.positions(3, 1) = place;
    CurveSkeleton skeleton = a_skeleton();
    skeleton.nodes(3, 1) = place;
    SkeletonContext context;
    for (const SkeletonFormat format : {SkeletonFormat::svg, SkeletonFormat::png}) {
      context.surface = &surface;
      expect_error(Fault::input, "finite",
                   [&] { (void)format_skeleton(a_skeleton(), format, context); });
      context.surface = &torus();
      if (std::isfinite(place)) {
        EXPECT_NO_THROW((void)format_skeleton(skeleton, format, context));
      } else {
        expect_error(Fault::input, "finite",
                     [&] { (void)format_skeleton(skeleton, format, context); });
      }
    }
    expect_error(Fault::input, "finite", [&] { (void)best_views(surface, 100, 100); });
    expect_error(Fault::input, "finite", [&] { (void)best_views(skeleton, 100, 100); });
  }
  expect_error(Fault::usage, "pixels", [] { (void)best_views(torus(), 0, 100); });
  expect_error(Fault::usage, "pixels", [] { (void)best_views(a_skeleton(), 100, -1); });
}

TEST(Misuse, WhatLivesForEverStaysAtEveryLevel) {
  CharacterRig character;
  character.rig = make_rig(torus(), a_skeleton());
  const CharacterRig last = level_of_character(character, a_skeleton(), lives_for_ever);
  const CharacterRig beyond = level_of_character(character, a_skeleton(), infinity);
  EXPECT_GE(beyond.rig.joints.rows(), 1);
  EXPECT_EQ(beyond.rig.names, last.rig.names);
  EXPECT_EQ(level_of_character(character, a_skeleton(), not_a_number).rig.names,
            character.rig.names);
  const CurveSkeleton ring = level_of(a_skeleton(), infinity);
  EXPECT_EQ(ring.edges, level_of(a_skeleton(), lives_for_ever).edges);
  EXPECT_EQ(graph_topology(ring).cycle_rank, 1);
  EXPECT_EQ(level_of(a_skeleton(), not_a_number).edges, a_skeleton().edges);
}

TEST(Misuse, CertificatesNeedASurfaceAndItsSize) {
  const SurfaceTree tree(torus());
  const Surface empty;
  Surface nowhere = torus();
  nowhere.positions(3, 1) = not_a_number;
  const CertificateOptions options;
  for (const Surface& spoilt : {empty, nowhere}) {
    expect_error(Fault::input, "evaluate", [&] {
      (void)evaluate({spoilt, tree, 8, 1, 1}, a_skeleton(), options, {});
    });
    expect_error(Fault::input, "evaluate", [&] { (void)evaluate(spoilt, a_skeleton()); });
  }
  for (const double diagonal : {0.0, -1.0, infinity, not_a_number}) {
    expect_error(Fault::input, "diagonal", [&] {
      (void)evaluate({torus(), tree, diagonal, 1, 1}, a_skeleton(), options, {});
    });
    expect_error(Fault::input, "diagonal",
                 [&] { (void)findings(tree, diagonal, a_skeleton(), options, {}); });
    expect_error(Fault::input, "diagonal", [&] {
      (void)common_ground(tree, diagonal, a_skeleton(), a_skeleton(), options, {});
    });
  }
}

TEST(Misuse, DistancesNeedASpacingAndPlaces) {
  CurveSkeleton nowhere = a_skeleton();
  nowhere.nodes(1, 1) = not_a_number;
  for (const auto& distance : {hausdorff_distance, mean_distance}) {
    EXPECT_NEAR(distance(a_skeleton(), a_skeleton(), 0.1), 0, 1e-12);
    for (const double spacing : {0.0, -1.0, infinity, not_a_number}) {
      expect_error(Fault::usage, "spacing",
                   [&] { (void)distance(a_skeleton(), a_skeleton(), spacing); });
    }
    expect_error(Fault::input, "finite", [&] { (void)distance(a_skeleton(), nowhere, 0.1); });
  }
}

}  // namespace
}  // namespace curveskel::misuse_laws
