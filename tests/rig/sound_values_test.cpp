// Skeletons, rigs, polygons and maps whose numbers are none of their own elements are refused where
// they enter, by every function that follows these numbers.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <curveskel.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::sound_values_laws {
namespace {

const Surface& torus() {
  static const Surface surface = shapes::torus(3, 1, 8).surface;
  return surface;
}

int vertices() { return static_cast<int>(torus().positions.rows()); }

/// The axis of the torus with a tail, so that it has a junction and a tip.
const CurveSkeleton& a_skeleton() {
  static const CurveSkeleton skeleton = [] {
    CurveSkeleton one = shapes::torus(3, 1, 8).axis;
    one.radii.setOnes(one.nodes.rows());
    one.lives.setOnes(one.nodes.rows());
    one.node_of_vertex.setZero(vertices());
    return add_node(one, 0, {5, 0, 0});
  }();
  return skeleton;
}

const Rig& a_rig() {
  static const Rig rig = [] {
    Rig one;
    one.joints = a_skeleton().nodes.topRows(3);
    one.parents.resize(3);
    one.parents << -1, 0, 1;
    one.names = {"a", "b", "c_end"};
    one.weights.resize(vertices(), 3);
    for (int v = 0; v < vertices(); ++v) one.weights.insert(v, v % 2) = 1;
    return one;
  }();
  return rig;
}

RepairedSurface as_if_repaired() {
  RepairedSurface repaired;
  repaired.surface = torus();
  repaired.vertex_of_input = Eigen::VectorXi::LinSpaced(vertices(), 0, vertices() - 1);
  return repaired;
}

CharacterRig character_of(const Rig& rig) {
  CharacterRig character;
  character.rig = rig;
  return character;
}

template <typename Value>
struct Entrance {
  std::string name;
  std::function<void(const Value&)> enter;
};

template <typename Value>
struct Spoilt {
  std::string words;
  Value value;
};

/// Each entrance lets the whole value in, and refuses each spoilt one by an Error in words.
template <typename Value>
void expect_guarded(const std::vector<Entrance<Value>>& entrances, const Value& whole,
                    const std::vector<Spoilt<Value>>& all_spoilt) {
  for (const auto& entrance : entrances) {
    EXPECT_NO_THROW(entrance.enter(whole)) << entrance.name;
    for (const auto& spoilt : all_spoilt) {
      try {
        entrance.enter(spoilt.value);
        ADD_FAILURE() << entrance.name << " lets in " << spoilt.words;
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input) << entrance.name << ": " << error.what();
        EXPECT_NE(std::string(error.what()).find("needed"), std::string::npos) << error.what();
      }
    }
  }
}

std::vector<Spoilt<CurveSkeleton>> spoilt_skeletons() {
  const int nodes = static_cast<int>(a_skeleton().nodes.rows());
  std::vector<Spoilt<CurveSkeleton>> all(4, {"", a_skeleton()});
  all[0].words = "an edge beyond the nodes";
  all[0].value.edges(2, 1) = 1000 * nodes;
  all[1].words = "an edge below the nodes";
  all[1].value.edges(2, 0) = -7;
  all[2].words = "few radii";
  all[2].value.radii.setOnes(3);
  all[3].words = "a vertex of no node";
  all[3].value.node_of_vertex[3] = 1000 * nodes;
  return all;
}

std::vector<Entrance<CurveSkeleton>> entrances_of_skeletons() {
  using Skeleton = const CurveSkeleton&;
  const int tail = edge_between(a_skeleton(), 0, static_cast<int>(a_skeleton().nodes.rows()) - 1);
  std::vector<Entrance<CurveSkeleton>> all{
      {"branches", [](Skeleton s) { (void)branches(s); }},
      {"branch_of_edges", [](Skeleton s) { (void)branch_of_edges(s); }},
      {"component_of_node", [](Skeleton s) { (void)component_of_node(s); }},
      {"graph_topology", [](Skeleton s) { (void)graph_topology(s); }},
      {"branch_measures", [](Skeleton s) { (void)branch_measures(s); }},
      {"junction_measures", [](Skeleton s) { (void)junction_measures(s); }},
      {"branch_profiles", [](Skeleton s) { (void)branch_profiles(torus(), s); }},
      {"branch_territories", [](Skeleton s) { (void)branch_territories(torus(), s); }},
      {"hausdorff_distance", [](Skeleton s) { (void)hausdorff_distance(s, a_skeleton(), 0.1); }},
      {"mean_distance", [](Skeleton s) { (void)mean_distance(a_skeleton(), s, 0.1); }},
      {"prune_branch", [tail](Skeleton s) { (void)prune_branch(s, tail); }},
      {"remove_node", [](Skeleton s) { (void)remove_node(s, 4); }},
      {"merge_nodes", [](Skeleton s) { (void)merge_nodes(s, 0, 5); }},
      {"move_node",
       [](Skeleton s) {
         (void)move_node(s, 0, {1, 2, 3});
       }},
      {"cut_edge", [](Skeleton s) { (void)cut_edge(s, 1); }},
      {"join_nodes", [](Skeleton s) { (void)join_nodes(s, 1, 7); }},
      {"split_edge", [](Skeleton s) { (void)split_edge(s, 3); }},
      {"add_node",
       [](Skeleton s) {
         (void)add_node(s, 3, {1, 2, 3});
       }},
      {"shortest_path", [](Skeleton s) { (void)shortest_path(s, 0, 7); }},
      {"edge_lives", [](Skeleton s) { (void)edge_lives(s); }},
      {"branch_levels", [](Skeleton s) { (void)branch_levels(s); }},
      {"level_of", [](Skeleton s) { (void)level_of(s, 1); }},
      {"level_limits", [](Skeleton s) { (void)level_limits(s, 3); }},
      {"labels_of_input",
       [](Skeleton s) { (void)labels_of_input(soup_of(torus()), as_if_repaired(), s); }},
      {"html_page", [](Skeleton s) { (void)html_page(torus(), s, {}, 1); }},
      {"best_views", [](Skeleton s) { (void)best_views(s, 100, 100); }},
      {"format_junctions", [](Skeleton s) { (void)format_junctions(s); }},
      {"match_skeletons",
       [](Skeleton s) {
         (void)match_skeletons({torus(), s}, {torus(), a_skeleton()});
       }},
      {"match_by_vertices",
       [](Skeleton s) {
         (void)match_by_vertices({torus(), a_skeleton()}, {torus(), s},
                                 as_if_repaired().vertex_of_input);
       }},
      {"level_of_character",
       [](Skeleton s) { (void)level_of_character(character_of(a_rig()), s, 1); }},
      {"rig_of_given", [](Skeleton s) {
         (void)rig_of_given(a_rig(), torus(), s, as_if_repaired().vertex_of_input, torus());
       }}};
  for (const auto& format : skeleton_formats) {
    all.push_back({"format_skeleton " + std::string(format.name), [&format](Skeleton s) {
                     SkeletonContext context;
                     context.surface = &torus();
                     (void)format_skeleton(s, format.value, context);
                   }});
  }
  return all;
}

TEST(SoundValues, LivesOfAnotherSkeletonAreNone) {
  EXPECT_TRUE(has_lives(add_node(a_skeleton(), 3, {1, 2, 3})));
  CurveSkeleton skeleton = a_skeleton();
  skeleton.lives.setOnes(3);
  EXPECT_EQ(remove_node(skeleton, 4).lives.size(), 0);
  EXPECT_EQ(split_edge(skeleton, 3).lives.size(), 0);
  EXPECT_EQ(level_of(skeleton, 1).edges, skeleton.edges);
}

TEST(SoundValues, AnEdgeFromANodeToItselfHasNoLife) {
  CurveSkeleton skeleton = a_skeleton();
  skeleton.edges(2, 0) = skeleton.edges(2, 1);
  EXPECT_THROW((void)edge_lives(skeleton), Error);
  EXPECT_THROW((void)branch_measures(skeleton), Error);
  EXPECT_THROW((void)level_limits(skeleton, 3), Error);
  EXPECT_THROW((void)format_skeleton(skeleton, SkeletonFormat::csv, {}), Error);
}

TEST(SoundValues, AnEdgeThatIsThereTwiceHasNoBranch) {
  CurveSkeleton skeleton = a_skeleton();
  skeleton.edges.row(4) = skeleton.edges.row(3);
  EXPECT_THROW((void)branch_of_edges(skeleton), Error);
  EXPECT_THROW((void)format_skeleton(skeleton, SkeletonFormat::ply, {}), Error);
}

TEST(SoundValues, SkeletonsWithNumbersOfNoNodeAreRefused) {
  expect_guarded(entrances_of_skeletons(), a_skeleton(), spoilt_skeletons());
}

std::vector<Spoilt<Rig>> spoilt_rigs() {
  std::vector<Spoilt<Rig>> all(8, {"", a_rig()});
  all[0].words = "a parent beyond the joints";
  all[0].value.parents[2] = 1000000;
  all[1].words = "a parent below -1";
  all[1].value.parents[2] = -7;
  all[2].words = "a joint that is its own parent";
  all[2].value.parents[1] = 1;
  all[3].words = "one parent";
  all[3].value.parents.conservativeResize(1);
  all[4].words = "one name";
  all[4].value.names.resize(1);
  all[5].words = "one role";
  all[5].value.roles = {"hips"};
  all[6].words = "one turn";
  all[6].value.turns = {Eigen::Quaterniond::Identity()};
  all[7].words = "weights of nine joints";
  all[7].value.weights.resize(vertices(), 9);
  return all;
}

std::vector<Entrance<Rig>> entrances_of_rigs() {
  using Given = const Rig&;
  const Eigen::RowVector3d up(0, 1, 0);
  std::vector<Entrance<Rig>> all{
      {"rig_of_given",
       [](Given rig) {
         (void)rig_of_given(rig, torus(), a_skeleton(), as_if_repaired().vertex_of_input, torus());
       }},
      {"level_of_character",
       [](Given rig) { (void)level_of_character(character_of(rig), a_skeleton(), 1); }},
      {"within_budget", [](Given rig) { (void)within_budget(character_of(rig), torus(), 2); }},
      {"with_ground_root", [up](Given rig) { (void)with_ground_root(rig, torus(), up); }},
      {"without_ends", [](Given rig) { (void)without_ends(rig); }},
      {"rig_for_export",
       [](Given rig) {
         (void)rig_for_export(rig, {}, torus(), {RestPose::input, true, false, false});
       }},
      {"name_roles",
       [](Given rig) {
         Rig named = rig;
         name_roles(named, {}, NameStyle::neutral);
       }},
      {"assign_role",
       [](Given rig) {
         Rig changed = rig;
         BodyPlan plan;
         assign_role(changed, plan, 1, "head", NameStyle::vrm);
       }},
      {"check_weights", [](Given rig) { (void)check_weights(torus(), rig); }},
      {"compare_rigs",
       [](Given rig) {
         (void)compare_rigs({torus(), rig}, {torus(), a_rig()});
       }},
      {"compare_rigs, the truth", [](Given rig) {
         (void)compare_rigs({torus(), a_rig()}, {torus(), rig});
       }}};
  for (const auto& format : rig_formats) {
    if (format.value == RigFormat::vrm) continue;  // a torus is no human
    all.push_back({"format_rig " + std::string(format.name), [&format](Given rig) {
                     (void)format_rig(torus(), rig, format.value, "torus", "");
                   }});
  }
  return all;
}

TEST(SoundValues, RigsWithNumbersOfNoJointAreRefused) {
  expect_guarded(entrances_of_rigs(), a_rig(), spoilt_rigs());
}

TEST(SoundValues, PosesNeedAMotionForEachJoint) {
  const JointTurns turns(3, Eigen::Quaterniond::Identity());
  const auto motions = joint_motions(a_rig(), turns);
  EXPECT_THROW((void)joint_motions(a_rig(), {}), Error);
  EXPECT_THROW((void)joint_motions(spoilt_rigs().front().value, turns), Error);
  EXPECT_THROW((void)moved_joints(a_rig(), {}), Error);
  EXPECT_THROW((void)moved_surface(torus().positions, a_rig(), {}), Error);
  EXPECT_THROW((void)moved_surface(torus().positions.topRows(3), a_rig(), motions), Error);
  EXPECT_EQ(moved_surface(torus().positions, a_rig(), motions), torus().positions);
}

std::vector<Spoilt<PolygonSoup>> spoilt_polygons() {
  std::vector<Spoilt<PolygonSoup>> all(5, {"", soup_of(torus())});
  all[0].words = "a corner beyond the vertices";
  all[0].value.corners[9] = 1000000;
  all[1].words = "a corner below the vertices";
  all[1].value.corners[9] = -3;
  all[2].words = "offsets beyond the corners";
  all[2].value.offsets.back() += 1000;
  all[3].words = "offsets that fall";
  std::swap(all[3].value.offsets[3], all[3].value.offsets[7]);
  all[4].words = "offsets below the corners";
  all[4].value.offsets.front() = -5;
  return all;
}

TEST(SoundValues, PolygonsThatSkipCornersAreRefused) {
  const auto labels = [](const PolygonSoup& soup) {
    BranchLabels all;
    all.of_vertex.setZero(soup.positions.rows());
    all.of_polygon.setZero(static_cast<Eigen::Index>(soup.offsets.size()) - 1);
    return all;
  };
  using Soup = const PolygonSoup&;
  std::vector<Entrance<PolygonSoup>> entrances{
      {"clean", [](Soup soup) { (void)clean(soup); }},
      {"fair_polygons", [](Soup soup) { (void)fair_polygons(soup); }},
      {"moved_vertices",
       [](Soup soup) { (void)moved_vertices(soup, as_if_repaired(), torus().positions); }},
      {"labels_of_input",
       [](Soup soup) { (void)labels_of_input(soup, as_if_repaired(), a_skeleton()); }},
      {"majority_labels", [](Soup soup) {
         (void)majority_labels(Eigen::VectorXi::Zero(vertices()), soup.corners, soup.offsets);
       }}};
  for (const auto& format : labelled_formats) {
    entrances.push_back(
        {"format_labelled_surface " + std::string(format.name), [&format, labels](Soup soup) {
           (void)format_labelled_surface(soup, labels(soup), format.value);
         }});
  }
  expect_guarded(entrances, soup_of(torus()), spoilt_polygons());
  EXPECT_THROW((void)format_labelled_surface(soup_of(torus()), {}, LabelledFormat::ply), Error);
}

TEST(SoundValues, WhatWasNeverFilledIsRefused) {
  EXPECT_THROW((void)clean({}), Error);
  EXPECT_THROW((void)repair({}), Error);
  EXPECT_THROW((void)rig_polygons({}), Error);
  CurveSkeleton nowhere = a_skeleton();
  nowhere.nodes(2, 0) = std::numeric_limits<double>::quiet_NaN();
  CurveSkeleton apart = a_skeleton();
  apart.contacts.emplace_back();
  for (const CurveSkeleton& spoilt : {nowhere, apart}) {
    EXPECT_THROW((void)dense_skeleton(torus(), spoilt), Error);
    EXPECT_THROW((void)make_rig(torus(), spoilt), Error);
    EXPECT_THROW((void)find_plan(torus(), spoilt), Error);
  }
}

TEST(SoundValues, MapsToNoVertexAreRefused) {
  RepairedSurface beyond = as_if_repaired();
  beyond.vertex_of_input[5] = 1000000;
  RepairedSurface short_of = as_if_repaired();
  short_of.vertex_of_input.resize(0);
  const PolygonSoup soup = soup_of(torus());
  for (const RepairedSurface& spoilt : {beyond, short_of}) {
    const Eigen::VectorXi& map = spoilt.vertex_of_input;
    EXPECT_THROW((void)labels_of_input(soup, spoilt, a_skeleton()), Error);
    EXPECT_THROW((void)moved_vertices(soup, spoilt, torus().positions), Error);
    EXPECT_THROW((void)rig_of_given(a_rig(), torus(), a_skeleton(), map, torus()), Error);
    EXPECT_THROW((void)skeleton_of_repaired(a_skeleton(), map, vertices()), Error);
    EXPECT_THROW(
        (void)match_inputs({soup, spoilt, a_skeleton()}, {soup, as_if_repaired(), a_skeleton()}),
        Error);
  }
  EXPECT_THROW((void)on_input_vertices(beyond, a_skeleton()), Error);
  EXPECT_THROW((void)skeleton_of_body(a_skeleton(), {}), Error);
  EXPECT_THROW((void)split_components(torus(), {}), Error);
  EXPECT_THROW((void)branch_measures(a_skeleton(), 1000000), Error);
  CurveSkeleton skeleton = a_skeleton();
  TipLife life;
  EXPECT_THROW(set_lives(skeleton, {life}), Error);
}

TEST(SoundValues, SurfacesWithCornersThatAreNoVerticesAreRefused) {
  using Given = const Surface&;
  std::vector<Entrance<Surface>> entrances{
      {"topology", [](Given s) { (void)topology(s); }},
      {"area", [](Given s) { (void)area(s); }},
      {"volume", [](Given s) { (void)volume(s); }},
      {"vertex_normals", [](Given s) { (void)vertex_normals(s); }},
      {"best_views", [](Given s) { (void)best_views(s, 100, 100); }},
      {"branch_territories", [](Given s) { (void)branch_territories(s, a_skeleton()); }},
      {"html_page", [](Given s) { (void)html_page(s, a_skeleton(), {}, 1); }},
      {"tip_lives", [](Given s) { (void)tip_lives(s); }},
      {"find_parts", [](Given s) { (void)find_parts(s); }},
      {"match_skeletons",
       [](Given s) {
         (void)match_skeletons({s, a_skeleton()}, {torus(), a_skeleton()});
       }},
      {"check_weights", [](Given s) { (void)check_weights(s, a_rig()); }},
      {"compare_rigs",
       [](Given s) {
         (void)compare_rigs({torus(), a_rig()}, {s, a_rig()});
       }},
      {"within_budget", [](Given s) { (void)within_budget(character_of(a_rig()), s, 2); }},
      {"format_rig", [](Given s) { (void)format_rig(s, a_rig(), RigFormat::glb, "torus", ""); }}};
  for (const auto& format : written_surface_formats) {
    entrances.push_back({"format_surface " + std::string(format.name),
                         [&format](Given s) { (void)format_surface(s, format.value); }});
  }
  std::vector<Spoilt<Surface>> spoilt(2, {"", torus()});
  spoilt[0].words = "a corner beyond the vertices";
  spoilt[0].value.triangles(7, 2) = 1000000;
  spoilt[1].words = "a corner below the vertices";
  spoilt[1].value.triangles(7, 2) = -5;
  expect_guarded(entrances, torus(), spoilt);
}

}  // namespace
}  // namespace curveskel::sound_values_laws
