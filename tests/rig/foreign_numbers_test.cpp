// Partitions, maps, sheets, contacts and polygons with numbers of another surface's elements are
// refused where they enter.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <curveskel.hpp>
#include "tests/rig/misuse_subjects.hpp"

namespace curveskel::foreign_numbers_laws {
namespace {

using namespace misuse;

TEST(ForeignNumbers, EdgesOfCornersBelowZeroAreNone) {
  Triangles triangles = torus().triangles;
  triangles(5, 1) = -1;
  expect_error(Fault::input, "corner -1", [&] { (void)index_edges(triangles); });
  triangles(5, 1) = std::numeric_limits<int>::max();
  expect_error(Fault::input, "corner", [&] { (void)index_edges(triangles); });
  EXPECT_TRUE(index_edges({}).edges.empty());
}

TEST(ForeignNumbers, APartitionKnowsItsGroups) {
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

TEST(ForeignNumbers, PartitionsOfAnotherSurfaceAreRefused) {
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

TEST(ForeignNumbers, MiddlesAreOfTheGraphsOwnPositions) {
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

TEST(ForeignNumbers, SheetsRimsAndMapsAreOfTheBody) {
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

TEST(ForeignNumbers, ContactsAreOfNodes) {
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

TEST(ForeignNumbers, ComponentsAreOfTheirSurface) {
  Surface two = torus();
  two.positions.conservativeResize(2 * torus().positions.rows(), 3);
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

TEST(ForeignNumbers, RigsAreWrittenWithFiniteNumbers) {
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

TEST(ForeignNumbers, MatchesNeedNodesOfVerticesRadiiAndPlaces) {
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

TEST(ForeignNumbers, MatchesNeedPolygonsOfTheirOwnVertices) {
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
}  // namespace curveskel::foreign_numbers_laws
