// Laws of the cut into pieces: cut curves, genus, and the graph that must come out.

#include <curveskel/advanced/surgery.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/cut/group_loop.hpp"
#include "skeleton/cut/level_set_graph.hpp"
#include "tests/skeleton/dwindling_rings.hpp"

namespace curveskel::surgery_laws {
namespace {

int cycle_rank(const PartitionGraph& graph) {
  CurveSkeleton skeleton;
  skeleton.nodes = Positions::Zero(graph.nodes(), 3);
  skeleton.edges = graph.edges;
  const GraphTopology counted = graph_topology(skeleton);
  EXPECT_EQ(counted.components, 1);
  return counted.cycle_rank;
}

/// The connected surfaces of the catalogue, made once.
const std::vector<shapes::Shape>& connected_shapes() {
  static const std::vector<shapes::Shape> found = [] {
    std::vector<shapes::Shape> made;
    for (const auto& entry : shapes::catalogue()) {
      auto shape = entry.make();
      if (shape.components == 1) made.push_back(std::move(shape));
    }
    return made;
  }();
  return found;
}

TEST(Groups, GenusOfTheWholeIsTheSurfaces) {
  for (const auto& shape : connected_shapes()) {
    SurfacePartition groups(shape.surface);
    const int vertices = static_cast<int>(shape.surface.positions.rows());
    // Any merge order will do as long as the two share an edge; vertices 0.. are grown from 0.
    std::vector<char> taken(static_cast<std::size_t>(vertices), 0);
    taken.at(0) = 1;
    std::vector<std::vector<int>> neighbours(taken.size());
    for (const auto& [a, b] : index_edges(shape.surface.triangles).edges) {
      neighbours[static_cast<std::size_t>(a)].push_back(b);
      neighbours[static_cast<std::size_t>(b)].push_back(a);
    }
    std::vector<int> queue{0};
    int last_genus = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const int v : neighbours[static_cast<std::size_t>(queue[i])]) {
        if (taken[static_cast<std::size_t>(v)] != 0) continue;
        taken[static_cast<std::size_t>(v)] = 1;
        queue.push_back(v);
        if (queue.size() % 64 == 0 || static_cast<int>(queue.size()) == vertices) {
          const int genus = groups.genus_of_union(v, 0);
          EXPECT_GE(genus, last_genus) << shape.name << ": genus of a growing piece never shrinks";
          last_genus = genus;
        }
        groups.merge(v, 0);
      }
    }
    EXPECT_EQ(last_genus, shape.genus) << shape.name;
    EXPECT_EQ(groups.triples(), 0) << shape.name;
  }
}

TEST(Groups, HalvesOfATorusMeetInTwoCircles) {
  const auto torus = shapes::torus(3, 1, 24);
  Eigen::VectorXi half(torus.surface.positions.rows());
  for (Eigen::Index v = 0; v < half.size(); ++v)
    half[v] = static_cast<int>(torus.surface.positions(v, 0) > 0);
  const PartitionGraph graph = partition_graph(torus.surface, half);
  EXPECT_EQ(graph.groups, 2);
  ASSERT_EQ(graph.cut_curves.size(), 2U);
  EXPECT_EQ(cycle_rank(graph), 1);
  EXPECT_EQ(genus_of_groups(torus.surface, index_edges(torus.surface.triangles), graph),
            (std::vector<int>{0, 0}));
  for (const auto& circle : graph.cut_curves) {
    EXPECT_GE(circle.size(), 24U);
    for (const auto& [a, b] : circle) {
      EXPECT_NE(graph.group_of_vertex[a], graph.group_of_vertex[b]);
    }
  }
}

TEST(LevelSets, CycleRankIsTheGenusOfEveryShape) {
  for (const auto& shape : connected_shapes()) {
    const LevelSetGraph level_sets = level_set_graph(shape.surface, {});
    EXPECT_EQ(cycle_rank(level_sets.graph), shape.genus) << shape.name;
    const auto genus = genus_of_groups(level_sets.surface,
                                       index_edges(level_sets.surface.triangles), level_sets.graph);
    EXPECT_EQ(std::count(genus.begin(), genus.end(), 0), level_sets.graph.groups) << shape.name;
  }
}

TEST(LevelSets, HandlesFinerThanASliceAreFoundBySubdividing) {
  // A torus of three by three rings: any cut by distance needs finer triangles first.
  const auto torus = shapes::torus(1, 0.6, 3);
  EXPECT_EQ(cycle_rank(level_set_graph(torus.surface, {}).graph), 1);
}

TEST(LevelSets, SplitNoSurfaceIntoFarMoreVerticesThanItHas) {
  for (const auto& shape : connected_shapes()) {
    const Eigen::Index given = shape.surface.positions.rows();
    const LevelSetGraph level_sets = level_set_graph(shape.surface, {});
    EXPECT_LT(level_sets.surface.positions.rows(), 8 * std::max<Eigen::Index>(32000, 4 * given))
        << shape.name;
  }
}

void expect_right_cut(const Surface& surface, int genus) {
  const LevelSetGraph level_sets = level_set_graph(surface, {});
  EXPECT_EQ(cycle_rank(level_sets.graph), genus);
  const auto of_groups = genus_of_groups(
      level_sets.surface, index_edges(level_sets.surface.triangles), level_sets.graph);
  EXPECT_EQ(std::count(of_groups.begin(), of_groups.end(), 0), level_sets.graph.groups);
  EXPECT_EQ(level_sets.surface.positions(level_sets.vertex_of_input, Eigen::all),
            surface.positions);
  EXPECT_EQ(topology(level_sets.surface).total_genus(), genus);
}

TEST(LevelSets, HandlesWithoutSizeAreCutAlongTheirEdges) {
  for (const auto& shape : connected_shapes()) {
    SCOPED_TRACE(shape.name);
    Surface point = shape.surface;
    point.positions.setZero();
    expect_right_cut(point, shape.genus);
  }
}

/// Vertices on a coarse grid: many lie in one place or equally far away, so that no level comes
/// between the saddles of their handles.
TEST(LevelSets, HandlesWhoseSaddlesShareALevelAreCutAlongTheirEdges) {
  for (const auto& shape : connected_shapes()) {
    for (const double step : {1.0, 0.5, 0.2}) {
      SCOPED_TRACE(shape.name + " " + std::to_string(step));
      Surface coarse = shape.surface;
      coarse.positions = step * (coarse.positions / step).array().round().matrix();
      expect_right_cut(coarse, shape.genus);
    }
  }
}

TEST(LoopOfHandle, PartsNoPieceAndCutsEachCorner) {
  for (const auto& shape : connected_shapes()) {
    if (shape.genus == 0) continue;
    SCOPED_TRACE(shape.name);
    const EdgeIndex index = index_edges(shape.surface.triangles);
    const Eigen::Index vertices = shape.surface.positions.rows();
    const std::vector<int> loop =
        loop_of_handle(shape.surface, index, Eigen::VectorXi::Zero(vertices), 0);
    const std::set<int> on_loop(loop.begin(), loop.end());
    ASSERT_EQ(on_loop.size(), loop.size());
    std::set<std::array<int, 2>> edges;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [low, high] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      EXPECT_TRUE(edges.insert({low, high}).second);
      EXPECT_TRUE(std::binary_search(index.edges.begin(), index.edges.end(),
                                     std::array<int, 2>{low, high}));
    }
    UnionFind faces(shape.surface.triangles.rows());
    std::vector<int> first_side(index.edges.size(), -1);
    int parts = static_cast<int>(shape.surface.triangles.rows());
    for (int t = 0; t < static_cast<int>(shape.surface.triangles.rows()); ++t) {
      int of_loop = 0;
      for (const int e : index.edge_of_corner.row(t)) {
        if (edges.contains(index.edges[static_cast<std::size_t>(e)])) {
          ++of_loop;
          continue;
        }
        int& side = first_side[static_cast<std::size_t>(e)];
        if (side >= 0 && faces.unite(side, t)) --parts;
        side = t;
      }
      EXPECT_LT(of_loop, 2);
    }
    EXPECT_EQ(parts, 1);
  }
}

TEST(LevelSets, SlicesAreAsNarrowAsNeededWhereTheyAreNeededOnly) {
  for (const double ratio : {10.0, 1e3, 1e5}) {
    SCOPED_TRACE(ratio);
    const auto shape = dwindling_rings(8, ratio);
    const LevelSetGraph level_sets = level_set_graph(shape.surface, {});
    EXPECT_EQ(cycle_rank(level_sets.graph), shape.genus);
    const auto genus = genus_of_groups(level_sets.surface,
                                       index_edges(level_sets.surface.triangles), level_sets.graph);
    EXPECT_EQ(std::count(genus.begin(), genus.end(), 0), level_sets.graph.groups);
    EXPECT_LT(level_sets.surface.positions.rows(), 3 * shape.surface.positions.rows());
    EXPECT_EQ(level_sets.surface.positions(level_sets.vertex_of_input, Eigen::all),
              shape.surface.positions);
    const Topology counted = topology(level_sets.surface);
    EXPECT_EQ(counted.components(), 1);
    EXPECT_EQ(counted.total_genus(), shape.genus);
  }
}

TEST(Surgery, CycleRankIsTheGenusAndEveryVertexHasOneGroup) {
  for (const auto& shape : connected_shapes()) {
    const SurfaceTree tree(shape.surface);
    const auto balls = inscribed_balls(shape.surface, tree, 1);
    const auto contracted = contract(shape.surface, balls.centres, {}, {});
    const auto graph = surgery(shape.surface, contracted, {}, {});
    ASSERT_TRUE(graph.has_value()) << shape.name << ": triangles remain";
    EXPECT_EQ(cycle_rank(*graph), shape.genus) << shape.name;
    EXPECT_EQ(graph->group_of_vertex.size(), shape.surface.positions.rows());
    EXPECT_GE(graph->group_of_vertex.minCoeff(), 0);
    EXPECT_LT(graph->group_of_vertex.maxCoeff(), graph->groups);
    const auto genus = genus_of_groups(shape.surface, index_edges(shape.surface.triangles), *graph);
    EXPECT_EQ(std::count(genus.begin(), genus.end(), 0), graph->groups) << shape.name;
  }
}

/// Two tips joined to a ring of vertices: each merge changes the edges of a tip, and a new
/// candidate for each of the tip's neighbours after each merge would fill the memory.
TEST(Surgery, TipsOfManyTrianglesTakeNoSquareOfTheirNumber) {
  constexpr Eigen::Index around = 20000;
  Surface spindle;
  spindle.positions.resize(around + 2, 3);
  spindle.triangles.resize(2 * around, 3);
  for (Eigen::Index k = 0; k < around; ++k) {
    const double angle = static_cast<double>(2 * EIGEN_PI) * static_cast<double>(k) / around;
    const double radius =
        0.01 * (1 + 0.1 * std::sin(7 * angle) + 0.01 * std::sin(1e4 * static_cast<double>(k)));
    const Eigen::Index next = (k + 1) % around;
    spindle.positions.row(k) << radius * std::cos(angle), radius * std::sin(angle), 0;
    const auto corner = [](Eigen::Index v) { return static_cast<std::int32_t>(v); };
    spindle.triangles.row(2 * k) << corner(k), corner(next), corner(around);
    spindle.triangles.row(2 * k + 1) << corner(next), corner(k), corner(around + 1);
  }
  spindle.positions.row(around) << 0, 0, 0.5;
  spindle.positions.row(around + 1) << 0, 0, -0.5;
  Contraction contracted;
  contracted.surface = spindle;
  contracted.vertex_of_input = Eigen::VectorXi::LinSpaced(around + 2, 0, around + 1);
  const auto graph = surgery(spindle, contracted, {}, {});
  ASSERT_TRUE(graph.has_value());
  EXPECT_EQ(cycle_rank(*graph), 0);
}

}  // namespace
}  // namespace curveskel::surgery_laws
