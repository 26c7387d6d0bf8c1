// Values that were moved from, choices that there are not, numbers of another surface's elements:
// each public function that takes them answers by an Error, or by what its header says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <curveskel.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::misuse_laws {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Surface& torus() {
  static const Surface surface = shapes::torus(3, 1, 8).surface;
  return surface;
}

int vertices() { return static_cast<int>(torus().positions.rows()); }

/// The axis of the torus, with a tail, a radius and a life at each node; every vertex belongs to
/// the nearest node.
const CurveSkeleton& a_skeleton() {
  static const CurveSkeleton skeleton = [] {
    CurveSkeleton one = shapes::torus(3, 1, 8).axis;
    one.radii.setOnes(one.nodes.rows());
    one.lives.setOnes(one.nodes.rows());
    one.node_of_vertex.resize(vertices());
    for (Eigen::Index v = 0; v < vertices(); ++v) {
      (one.nodes.rowwise() - torus().positions.row(v))
          .rowwise()
          .squaredNorm()
          .minCoeff(&one.node_of_vertex[v]);
    }
    return add_node(one, 0, {5, 0, 0});
  }();
  return skeleton;
}

RepairedSurface as_if_repaired() {
  RepairedSurface repaired;
  repaired.surface = torus();
  repaired.vertex_of_input = Eigen::VectorXi::LinSpaced(vertices(), 0, vertices() - 1);
  return repaired;
}

/// The fault and the message of the Error that the call throws; nothing where it throws none.
std::optional<std::pair<Fault, std::string>> error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::pair{error.fault(), std::string(error.what())};
  }
  return std::nullopt;
}

void expect_error(Fault fault, const std::string& words, const std::function<void()>& call) {
  const auto error = error_of(call);
  if (!error) {
    ADD_FAILURE() << "no error that says " << words;
    return;
  }
  EXPECT_EQ(error->first, fault) << error->second;
  EXPECT_NE(error->second.find(words), std::string::npos) << error->second;
  EXPECT_NE(error->second.find("needed"), std::string::npos) << error->second;
}

TEST(Misuse, ATreeThatWasMovedFromSaysSo) {
  SurfaceTree tree(torus());
  const SurfaceTree moved_to = std::move(tree);
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
  LeastSquares moved_to = std::move(solver);
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

TEST(Misuse, EdgesOfCornersBelowZeroAreNone) {
  Triangles triangles = torus().triangles;
  triangles(5, 1) = -1;
  expect_error(Fault::input, "corner -1", [&] { (void)index_edges(triangles); });
  triangles(5, 1) = std::numeric_limits<int>::max();
  expect_error(Fault::input, "corner", [&] { (void)index_edges(triangles); });
  EXPECT_TRUE(index_edges({}).edges.empty());
}

TEST(Misuse, APartitionKnowsItsGroups) {
  Surface spoilt = torus();
  spoilt.triangles(5, 1) = vertices();
  expect_error(Fault::input, "corner", [&] { (void)SurfacePartition(spoilt); });
  SurfacePartition groups(torus());
  for (const int none : {-1, vertices(), std::numeric_limits<int>::max()}) {
    EXPECT_THROW((void)groups.group_of(none), std::out_of_range);
    EXPECT_THROW((void)groups.triple_neighbours(none), std::out_of_range);
    EXPECT_THROW((void)groups.share_triple(0, none), std::out_of_range);
    EXPECT_THROW((void)groups.genus_of_union(none, 0), std::out_of_range);
    EXPECT_THROW(groups.merge(0, none), std::out_of_range);
  }
  const int triples = groups.triples();
  groups.merge(3, 3);
  EXPECT_EQ(groups.triples(), triples);
  EXPECT_EQ(groups.group_of(3), 3);
  EXPECT_EQ(groups.genus_of_union(3, 3), 0);
}

/// The torus in two halves, which meet along two cut curves.
Eigen::VectorXi halves() {
  Eigen::VectorXi group(vertices());
  for (int v = 0; v < vertices(); ++v) group[v] = torus().positions(v, 0) > 0.1 ? 1 : 0;
  return group;
}

TEST(Misuse, PartitionsOfAnotherSurfaceAreRefused) {
  const EdgeIndex index = index_edges(torus().triangles);
  const PartitionGraph whole = partition_graph(torus(), index, halves());
  ASSERT_EQ(whole.groups, 2);
  ASSERT_EQ(whole.cut_curves.size(), 2);
  for (const int beyond : {-1, vertices(), std::numeric_limits<int>::max()}) {
    Eigen::VectorXi group = halves();
    group[7] = beyond;
    expect_error(Fault::input, "number", [&] { (void)partition_graph(torus(), group); });
    EdgeIndex no_edge = index;
    no_edge.edge_of_corner(4, 2) = beyond;
    if (beyond != vertices()) {  // an edge has that number
      expect_error(Fault::input, "number",
                   [&] { (void)partition_graph(torus(), no_edge, halves()); });
    }
    EdgeIndex no_end = index;
    no_end.edges[4][1] = beyond;
    expect_error(Fault::input, "number", [&] { (void)partition_graph(torus(), no_end, halves()); });
  }
  expect_error(Fault::input, "vertices", [&] { (void)partition_graph(torus(), {}); });
  expect_error(Fault::input, "triangles", [&] { (void)partition_graph(torus(), {}, halves()); });
  expect_error(Fault::input, "three groups", [&] {
    (void)partition_graph(torus(), Eigen::VectorXi::LinSpaced(vertices(), 0, vertices() - 1));
  });
  Surface open = torus();
  open.triangles.conservativeResize(open.triangles.rows() / 2, 3);
  expect_error(Fault::input, "cut curve that ends", [&] {
    Eigen::VectorXi group(vertices());
    for (int v = 0; v < vertices(); ++v) group[v] = torus().positions(v, 2) > 0.1 ? 1 : 0;
    (void)partition_graph(open, group);
  });
  EXPECT_EQ(partition_graph({}, Eigen::VectorXi()).nodes(), 0);
}

TEST(Misuse, MiddlesAreOfTheGraphsOwnPositions) {
  const PartitionGraph whole = partition_graph(torus(), halves());
  const auto refused = [](const std::string& words, const PartitionGraph& graph,
                          const Positions& positions) {
    expect_error(Fault::input, words, [&] { (void)middles_of_groups(graph, positions); });
  };
  EXPECT_TRUE(middles_of_groups(whole, torus().positions).allFinite());
  refused("positions", whole, torus().positions.topRows(9));
  PartitionGraph spoilt = whole;
  spoilt.group_of_vertex[3] = 2;
  refused("number 2", spoilt, torus().positions);
  spoilt = whole;
  spoilt.groups = 3;
  refused("without vertices", spoilt, torus().positions);
  spoilt = whole;
  spoilt.cut_curves[1][0][1] = -4;
  refused("number -4", spoilt, torus().positions);
  spoilt = whole;
  spoilt.cut_curves[1].clear();
  refused("without vertices", spoilt, torus().positions);
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

TEST(Misuse, SheetsRimsAndMapsAreOfTheBody) {
  for (const int beyond : {-1, vertices(), std::numeric_limits<int>::max()}) {
    RepairedSurface sheet = as_if_repaired();
    sheet.sheets = {0, beyond};
    RepairedSurface rim = as_if_repaired();
    rim.rims = {{0, 1, beyond}};
    RepairedSurface map = as_if_repaired();
    map.vertex_of_input[4] = beyond;
    std::vector<RepairedSurface> all{sheet, rim};
    if (beyond >= 0) all.push_back(map);  // -1 is a vertex of the file that was dropped
    for (const RepairedSurface& spoilt : all) {
      const auto refused = [](const std::function<void()>& call) {
        expect_error(Fault::input, "vertex", call);
      };
      refused([&] { (void)rig_body(torus(), spoilt, a_skeleton()); });
      refused([&] { (void)rig_character(torus(), spoilt, a_skeleton()); });
      refused([&] { (void)made_of_tubes_but_for_sheets(1, spoilt); });
      refused([&] { (void)body_of(spoilt, find_parts(torus())); });
      refused([&] { (void)extract_repaired(spoilt); });
      refused([&] { (void)evaluate_repaired(spoilt, {}, a_skeleton()); });
    }
    PlanOptions plan;
    plan.sheets = {beyond};
    expect_error(Fault::usage, "PlanOptions::sheets has vertex",
                 [&] { (void)find_plan(torus(), a_skeleton(), plan); });
  }
  RepairedSurface short_of = as_if_repaired();
  short_of.vertex_of_input.conservativeResize(3);
  expect_error(Fault::input, "map of 3", [&] { (void)rig_body(torus(), short_of, a_skeleton()); });
  expect_error(Fault::input, "map of 3",
               [&] { (void)rig_character(torus(), short_of, a_skeleton()); });
}

TEST(Misuse, ContactsAreOfNodes) {
  for (const int beyond : {-1, 1000000}) {
    CurveSkeleton node = a_skeleton();
    node.contacts.resize(1);
    node.contacts[0].one.node = 0;
    node.contacts[0].other.node = beyond;
    CurveSkeleton tip = node;
    tip.contacts[0].other = {1, {0, beyond}};
    for (const CurveSkeleton& spoilt : {node, tip}) {
      expect_error(Fault::input, "contact",
                   [&] { (void)skeleton_of_body(spoilt, find_parts(torus())); });
      expect_error(Fault::input, "contact", [&] { (void)make_rig(torus(), spoilt); });
      expect_error(Fault::input, "contact", [&] { (void)dense_skeleton(torus(), spoilt); });
      expect_error(Fault::input, "contact", [&] { (void)place_joints(spoilt); });
    }
  }
}

TEST(Misuse, ComponentsAreOfTheirSurface) {
  Surface two = torus();
  two.positions.conservativeResize(2 * vertices(), 3);
  two.positions.bottomRows(vertices()) = torus().positions.rowwise() + Eigen::RowVector3d(20, 0, 0);
  two.triangles.resize(2 * torus().triangles.rows(), 3);
  two.triangles << torus().triangles, torus().triangles.array() + vertices();
  const Topology counted = topology(two);
  ASSERT_EQ(split_components(two, counted).size(), 2);
  std::vector<Topology> all(4, counted);
  all[0].component_of_vertex[3] = 1;
  all[1].component_of_vertex[3] = 2;
  all[2].vertices.pop_back();
  all[3].faces[0] -= 1;
  for (const Topology& spoilt : all) {
    expect_error(Fault::input, "topology", [&] { (void)split_components(two, spoilt); });
  }
}

TEST(Misuse, RigsAreWrittenWithFiniteNumbers) {
  const Rig rig = make_rig(torus(), a_skeleton());
  for (const double number : {not_a_number, infinity}) {
    Rig place = rig;
    place.joints(1, 2) = number;
    Rig weight = rig;
    weight.weights.coeffRef(3, 0) = static_cast<float>(number);
    for (const auto& format : rig_formats) {
      for (const Rig& spoilt : {place, weight}) {
        expect_error(Fault::input, "finite",
                     [&] { (void)format_rig(torus(), spoilt, format.value, "torus", ""); });
      }
    }
    expect_error(Fault::input, "finite",
                 [&] { (void)weights_on_joints(torus(), a_skeleton(), place); });
  }
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

TEST(Misuse, MatchesNeedNodesOfVerticesRadiiAndPlaces) {
  const Eigen::VectorXi same = as_if_repaired().vertex_of_input;
  const auto refused = [&](const std::string& words, const CurveSkeleton& spoilt) {
    const MatchSide whole{torus(), a_skeleton()};
    const MatchSide side{torus(), spoilt};
    expect_error(Fault::input, words, [&] { (void)match_skeletons(side, whole); });
    expect_error(Fault::input, words, [&] { (void)match_skeletons(whole, side); });
    expect_error(Fault::input, words, [&] { (void)match_by_vertices(side, whole, same); });
    expect_error(Fault::input, words, [&] { (void)match_by_vertices(whole, side, same); });
  };
  CurveSkeleton spoilt = a_skeleton();
  spoilt.node_of_vertex.setConstant(-1);
  refused("has a node", spoilt);
  for (const double number : {not_a_number, infinity}) {
    spoilt = a_skeleton();
    spoilt.radii[2] = number;
    refused("radius", spoilt);
    spoilt = a_skeleton();
    spoilt.nodes(2, 0) = number;
    refused("finite", spoilt);
  }
  // Some vertices may be without a node.
  spoilt = a_skeleton();
  for (int v = 0; v < vertices(); v += 3) spoilt.node_of_vertex[v] = -1;
  const MatchSide some{torus(), spoilt};
  const SkeletonMatch match = match_skeletons(some, {torus(), a_skeleton()});
  EXPECT_EQ(match.branches.size(), branches(a_skeleton()).size());
  for (int v = 0; v < vertices(); v += 3) EXPECT_EQ(match.vertex_of_a[v], -1);
  EXPECT_EQ(match_by_vertices(some, some, same).branches.size(), match.branches.size());
}

TEST(Misuse, MatchesNeedPolygonsOfTheirOwnVertices) {
  PolygonSoup spoilt = soup_of(torus());
  spoilt.corners[9] = 1000000;
  const RepairedSurface repaired = as_if_repaired();
  const PolygonSoup whole = soup_of(torus());
  expect_error(Fault::input, "corner", [&] {
    (void)match_inputs({spoilt, repaired, a_skeleton()}, {spoilt, repaired, a_skeleton()});
  });
  expect_error(Fault::input, "corner", [&] {
    (void)match_inputs({whole, repaired, a_skeleton()}, {spoilt, repaired, a_skeleton()});
  });
}

}  // namespace
}  // namespace curveskel::misuse_laws
