// The law that everything else rests on: whatever closed orientable surface goes in, each of its
// components comes out as one connected curve with as many independent cycles as it has handles.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "tests/skeleton/dwindling_rings.hpp"

namespace curveskel::topology_law_laws {
namespace {

using Eigen::Vector3d;
using shapes::Shape;
using std::numbers::pi;

/// Cycle rank of what the vertices of each component of the surface belong to.
std::vector<int> cycles_by_component(const Topology& counted, const CurveSkeleton& skeleton) {
  std::vector<int> component(static_cast<std::size_t>(skeleton.nodes.rows()), -1);
  for (Eigen::Index v = 0; v < counted.component_of_vertex.size(); ++v) {
    component[static_cast<std::size_t>(skeleton.node_of_vertex[v])] =
        counted.component_of_vertex[v];
  }
  // A node that no vertex is nearest to has the component of its neighbours.
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& edge : skeleton.edges.rowwise()) {
      int& a = component[static_cast<std::size_t>(edge(0))];
      int& b = component[static_cast<std::size_t>(edge(1))];
      if (a == b) continue;
      EXPECT_TRUE(a < 0 || b < 0) << "an edge from one component to another";
      if (a >= 0 && b >= 0) continue;
      a = b = std::max(a, b);
      changed = true;
    }
  }
  std::vector<int> cycles(static_cast<std::size_t>(counted.components()), 1);
  for (const int c : component) {
    EXPECT_GE(c, 0) << "a node that belongs to no component";
    if (c >= 0) --cycles[static_cast<std::size_t>(c)];
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    ++cycles[static_cast<std::size_t>(component[static_cast<std::size_t>(edge(0))])];
  }
  return cycles;
}

Extraction expect_law(const Shape& shape) {
  SCOPED_TRACE(shape.name);
  const Topology counted = topology(shape.surface);
  EXPECT_EQ(counted.components(), shape.components);
  EXPECT_EQ(counted.total_genus(), shape.genus);
  Extraction found = extract(shape.surface, {}, {});
  EXPECT_TRUE(found.certificate.topology_correct());
  EXPECT_EQ(graph_topology(found.skeleton).components, shape.components);
  EXPECT_EQ(cycles_by_component(counted, found.skeleton), counted.genus);
  return found;
}

CurveSkeleton graph_of(const std::vector<Vector3d>& nodes, const std::vector<double>& radii,
                       std::vector<std::pair<int, int>> edges) {
  CurveSkeleton graph;
  graph.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
  graph.radii = Eigen::Map<const Eigen::VectorXd>(radii.data(), graph.nodes.rows());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    graph.nodes.row(static_cast<Eigen::Index>(i)) = nodes[i];
  }
  std::sort(edges.begin(), edges.end());
  graph.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    graph.edges.row(static_cast<Eigen::Index>(e)) << edges[e].first, edges[e].second;
  }
  return graph;
}

/// Through the nodes in turn and back, by way of tube_union: for curves of any shape.
CurveSkeleton closed_curve(const std::function<Vector3d(double)>& at, int nodes, double radius) {
  std::vector<Vector3d> points;
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < nodes; ++i) {
    points.push_back(at(2 * pi * i / nodes));
    if (i > 0) edges.emplace_back(i - 1, i);
  }
  edges.emplace_back(0, nodes - 1);
  return graph_of(points, std::vector<double>(points.size(), radius), edges);
}

/// Once round the torus p times, q times through its hole.
Shape torus_knot(int p, int q) {
  const auto curve = closed_curve(
      [=](double t) {
        const double wide = 4 + 1.8 * std::cos(q * t);
        return Vector3d(wide * std::cos(p * t), wide * std::sin(p * t), 1.8 * std::sin(q * t));
      },
      40 * std::max(p, q), 0.4);
  return shapes::tube_union("knot-" + std::to_string(p) + "-" + std::to_string(q), curve, {0, 1.5});
}

Shape figure_eight_knot() {
  return shapes::tube_union("figure-eight-knot",
                            closed_curve(
                                [](double t) {
                                  const double wide = 2 + std::cos(2 * t);
                                  return Vector3d(2 * wide * std::cos(3 * t),
                                                  2 * wide * std::sin(3 * t), 2 * std::sin(4 * t));
                                },
                                160, 0.4),
                            {0, 1.5});
}

/// Three rings of which no two are linked, and yet none comes loose.
Shape borromean_rings() {
  const auto ring = [](int axis) {
    return shapes::tube_union("",
                              closed_curve(
                                  [axis](double t) {
                                    Vector3d p = Vector3d::Zero();
                                    p[axis] = 5 * std::cos(t);
                                    p[(axis + 1) % 3] = 2.2 * std::sin(t);
                                    return p;
                                  },
                                  60, 0.35),
                              {0, 1.5});
  };
  return shapes::together("borromean-rings", {ring(0), ring(1), ring(2)});
}

Shape chain(int rings) {
  std::vector<Shape> parts;
  for (int i = 0; i < rings; ++i) {
    Shape ring = shapes::torus(3, 0.6, 8);
    if (i % 2 == 1) ring = shapes::rotated(std::move(ring), Vector3d::UnitX(), pi / 2);
    parts.push_back(shapes::translated(std::move(ring), Vector3d(4 * i, 0, 0)));
  }
  return shapes::together("chain-" + std::to_string(rings), parts);
}

/// The edges of a grid of cubes as thin bars.
Shape lattice(int side) {
  std::vector<Vector3d> nodes;
  std::vector<std::pair<int, int>> edges;
  const auto index = [&](int x, int y, int z) { return (x * side + y) * side + z; };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        nodes.emplace_back(6 * x, 6 * y, 6 * z);
        if (x > 0) edges.emplace_back(index(x - 1, y, z), index(x, y, z));
        if (y > 0) edges.emplace_back(index(x, y - 1, z), index(x, y, z));
        if (z > 0) edges.emplace_back(index(x, y, z - 1), index(x, y, z));
      }
    }
  }
  return shapes::tube_union("lattice-" + std::to_string(side),
                            graph_of(nodes, std::vector<double>(nodes.size(), 0.7), edges),
                            {0, 1.5});
}

/// A ball with two thin handles on each of six sides.
Shape ball_with_thin_handles() {
  std::vector<Vector3d> nodes{Vector3d::Zero()};
  std::vector<double> radii{2};
  std::vector<std::pair<int, int>> edges;
  for (int side = 0; side < 6; ++side) {
    const Vector3d out = (side % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(side / 2);
    const Vector3d along = Vector3d::Unit((side / 2 + 1) % 3);
    const Vector3d across = Vector3d::Unit((side / 2 + 2) % 3);
    for (const double shift : {-0.6, 0.6}) {
      for (const double end : {-1.0, 1.0}) {
        for (const double height : {1.5, 3.0}) {
          nodes.push_back(height * out + 0.8 * end * along + shift * across);
          radii.push_back(0.12);
        }
      }
      const int last = static_cast<int>(nodes.size()) - 1;
      edges.insert(edges.end(), {{last - 3, last - 2}, {last - 2, last}, {last - 1, last}});
      edges.insert(edges.end(), {{0, last - 3}, {0, last - 1}});
    }
  }
  return shapes::tube_union("ball-with-thin-handles", graph_of(nodes, radii, edges), {0, 1.5});
}

/// The same graph with thinner and thinner tubes, one in the other.
Shape nested(const std::string& name, CurveSkeleton graph, int shells) {
  std::vector<Shape> parts;
  for (int shell = 0; shell < shells; ++shell) {
    parts.push_back(shapes::tube_union("", graph, {0, 1.5}));
    graph.radii *= 0.5;
  }
  return shapes::together(name, parts);
}

Shape nested_spheres() {
  std::vector<Shape> parts;
  for (double radius = 1; radius > 0.1; radius *= 0.6) {
    parts.push_back(shapes::ellipsoid(Vector3d::Constant(radius), 3));
  }
  return shapes::together("nested-spheres", parts);
}

/// Of genus 0 to 3, each with so few vertices that it has to be refined.
Shape crowd(int components) {
  shapes::Random random(3);
  std::vector<Shape> kinds{shapes::ellipsoid({1, 1, 1}, 1), shapes::torus(1, 0.4, 4),
                           shapes::box({1, 0.5, 0.5}, 3)};
  for (const int loops : {2, 3}) {
    kinds.push_back(shapes::scaled(
        shapes::tube_union("", shapes::ring_chain(loops, 2.2, 1), {0, 1}), 1.0 / (4 * loops)));
  }
  std::vector<Shape> parts;
  for (int c = 0; c < components; ++c) {
    Shape part =
        shapes::rotated(kinds[random.index(kinds.size())], {1, 2, 3}, random.uniform(0, 3));
    part = shapes::scaled(std::move(part), std::exp(random.uniform(-5, 0)));
    const int row = c / 20;
    parts.push_back(shapes::translated(std::move(part), Vector3d(4 * (c % 20), 4 * row, 0)));
  }
  return shapes::together("crowd-" + std::to_string(components), parts);
}

TEST(TopologyLaw, Knots) {
  for (const auto& [p, q] : {std::pair{2, 3}, {2, 5}, {3, 4}, {3, 5}}) expect_law(torus_knot(p, q));
  expect_law(figure_eight_knot());
}

TEST(TopologyLaw, Links) {
  expect_law(borromean_rings());
  expect_law(chain(6));
}

TEST(TopologyLaw, ManyAndThinHandles) {
  expect_law(lattice(2));
  expect_law(lattice(3));
  expect_law(ball_with_thin_handles());
  expect_law(dwindling_rings(8, 100));
  EXPECT_TRUE(is_kept(expect_law(dwindling_rings(8, 1e4)).history, try_level_sets));
}

TEST(ThoroughTopologyLaw, MoreHandlesThanTheUsualWorkingVerticesHold) {
  // Its handles need more than the 8,000 working vertices that are usual.
  const Extraction found = expect_law(shapes::subdivided(shapes::sieve(20)));
  EXPECT_GE(found.components.front().working_vertices, 32 * 400);
  EXPECT_FALSE(is_kept(found.history, try_level_sets));
}

TEST(TopologyLaw, NestedShells) {
  expect_law(nested_spheres());
  expect_law(nested("nested-rings", shapes::ring_chain(3, 4, 1.2), 3));
  expect_law(nested("nested-star", shapes::star(5, 8, 1.2), 3));
}

TEST(TopologyLaw, TheCoarsestTriangulations) {
  for (const int sides : {3, 4, 5}) {
    expect_law(shapes::tube("ring", shapes::circle(3), shapes::constant(1), sides));
    expect_law(shapes::tube("rod", shapes::straight(4), shapes::constant(1), sides));
  }
  expect_law(shapes::ellipsoid({1, 1, 1}, 0));
  expect_law(shapes::tube_union("coarse-rings", shapes::ring_chain(4, 2.2, 1), {0, 1}));
}

TEST(TopologyLaw, NoiseThatFoldsTheSurface) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    expect_law(shapes::noisy(shapes::torus(3, 1, 12), 0.3, seed));
    expect_law(shapes::noisy(shapes::tube_union("rings", shapes::ring_chain(3, 3, 1), {0, 1.5}),
                             0.3, seed));
  }
}

// ---- Work that stays within the size of the surface
// ----------------------------------------------

int working_vertices(const Extraction& found) {
  return std::accumulate(
      found.components.begin(), found.components.end(), 0,
      [](int sum, const ComponentRecord& one) { return sum + one.working_vertices; });
}

TEST(TopologyLaw, ACrowdOfComponentsIsNotRefinedWithoutEnd) {
  EXPECT_LE(working_vertices(expect_law(crowd(300))), 300000);
}

TEST(TopologyLaw, ACrowdIsTheSameWithOneThreadOrThree) {
  const Shape shape = crowd(24);
  ExtractOptions options;
  options.threads = 1;
  const CurveSkeleton alone = extract(shape.surface, options, {}).skeleton;
  options.threads = 3;
  const CurveSkeleton together = extract(shape.surface, options, {}).skeleton;
  EXPECT_EQ(alone.nodes, together.nodes);
  EXPECT_EQ(alone.edges, together.edges);
  EXPECT_EQ(alone.radii, together.radii);
  EXPECT_EQ(alone.node_of_vertex, together.node_of_vertex);
}

TEST(TopologyLaw, AVertexThrownFarOutCostsNoMoreThanAnyOther) {
  Shape shape = shapes::torus(3, 1, 12);
  shape.surface.positions.row(0) << 1e3, 0, 0;
  EXPECT_LE(working_vertices(expect_law(shape)), 3 * 1500);
  // Now the torus is thinner than 1e-5 D, where no ball fits: its cycle cannot be led round.
  shape.surface.positions.row(0) << 1e6, 0, 0;
  const Extraction found = extract(shape.surface, {}, {});
  EXPECT_LE(working_vertices(found), 3 * 1500);
  EXPECT_EQ(cycles_by_component(topology(shape.surface), found.skeleton), std::vector<int>{1});
  EXPECT_EQ(found.certificate.components, 1);
}

}  // namespace
}  // namespace curveskel::topology_law_laws
