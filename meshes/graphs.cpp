// Graphs with known tips, junctions and cycles, for tube_union.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <curveskel/error.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct GraphBuilder {
  std::vector<Vector3d> nodes;
  std::vector<double> radii;
  std::vector<std::array<int, 2>> edges;

  int node(const Vector3d& position, double radius) {
    nodes.push_back(position);
    radii.push_back(radius);
    return static_cast<int>(nodes.size()) - 1;
  }
  void edge(int i, int j) { edges.push_back({std::min(i, j), std::max(i, j)}); }

  CurveSkeleton graph() {
    std::sort(edges.begin(), edges.end());
    CurveSkeleton result;
    result.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    result.radii.resize(static_cast<Eigen::Index>(nodes.size()));
    result.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      result.nodes.row(static_cast<Eigen::Index>(i)) = nodes[i].transpose();
      result.radii[static_cast<Eigen::Index>(i)] = radii[i];
    }
    for (std::size_t e = 0; e < edges.size(); ++e)
      result.edges.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
    return result;
  }
};

// Distance between the segments a0a1 and b0b1, by alternating projection: the squared distance is
// convex in the two parameters, and clamping keeps each step's minimum.
double segment_distance(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                        const Vector3d& b1) {
  const auto nearest = [](const Vector3d& p, const Vector3d& from, const Vector3d& to) {
    const Vector3d along = to - from;
    return Vector3d(from +
                    std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& start : {a0, Vector3d((a0 + a1) / 2), a1}) {
    Vector3d p = start;
    for (int i = 0; i < 60; ++i) {
      const Vector3d q = nearest(p, b0, b1);
      p = nearest(q, a0, a1);
      least = std::min(least, (p - q).norm());
    }
  }
  return least;
}

// True if a straight edge i-j would stay well apart from all edges that are there.
bool has_room(const GraphBuilder& graph, int i, int j, double clearance) {
  const auto at = [&](int k) { return graph.nodes[static_cast<std::size_t>(k)]; };
  const Vector3d direction = (at(j) - at(i)).normalized();
  for (std::size_t k = 0; k < graph.nodes.size(); ++k) {
    const auto node = static_cast<int>(k);
    if (node != i && node != j &&
        segment_distance(at(i), at(j), at(node), at(node) + Vector3d(1e-9, 0, 0)) < clearance)
      return false;
  }
  int degree_i = 0;
  int degree_j = 0;
  for (const auto& edge : graph.edges) {
    bool shares = false;
    for (int k = 0; k < 2; ++k) {
      const int shared = edge[static_cast<std::size_t>(k)];
      if (shared != i && shared != j) continue;
      shares = true;
      ++(shared == i ? degree_i : degree_j);
      const int other = edge[static_cast<std::size_t>(1 - k)];
      const Vector3d away = shared == i ? direction : Vector3d(-direction);
      if ((at(other) - at(shared)).normalized().dot(away) > std::cos(75 * pi / 180)) return false;
      if (other == i || other == j) return false;  // the same edge again
    }
    if (!shares && segment_distance(at(i), at(j), at(edge[0]), at(edge[1])) < clearance)
      return false;
  }
  return degree_i < 4 && degree_j < 4;
}

// A tree grown twig by twig within a ball, then loops between its nodes where there is room.
bool grow_random(GraphBuilder& graph, Random& random, int nodes, int loops, double radius) {
  // The thickest tube is 1.5 radius: this leaves at least one radius between two surfaces.
  const double clearance = 4 * radius;
  const double confine = 7 * radius * std::cbrt(static_cast<double>(nodes));
  graph.node(Vector3d::Zero(), radius * random.uniform(1, 1.5));
  for (int tries = 0; static_cast<int>(graph.nodes.size()) < nodes; ++tries) {
    if (tries > 100 * nodes) return false;
    const auto from = static_cast<int>(random.index(graph.nodes.size()));
    const Vector3d direction =
        Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Vector3d p =
        graph.nodes[static_cast<std::size_t>(from)] + radius * random.uniform(8, 14) * direction;
    if (p.norm() > confine) continue;
    const int end = graph.node(p, radius * random.uniform(1, 1.5));
    if (has_room(graph, from, end, clearance)) {
      graph.edge(from, end);
    } else {
      graph.nodes.pop_back();
      graph.radii.pop_back();
    }
  }
  for (const int pair : random.permutation(nodes * nodes)) {
    const int i = pair / nodes;
    const int j = pair % nodes;
    if (i >= j || loops == 0 || !has_room(graph, i, j, clearance)) continue;
    graph.edge(i, j);
    --loops;
  }
  return loops == 0;
}

}  // namespace

CurveSkeleton star(int arms, double length, double radius) {
  GraphBuilder graph;
  const int centre = graph.node(Vector3d::Zero(), radius);
  for (int i = 0; i < arms; ++i) {
    Vector3d direction;
    if (arms <= 4) {
      const double angle = 2 * pi * i / arms;
      direction = Vector3d(std::cos(angle), std::sin(angle), 0);
    } else {  // Fibonacci points on the sphere
      const double z = 1 - (2 * i + 1.0) / arms;
      const double angle = 2 * pi * i * (std::numbers::phi - 1);
      const double width = std::sqrt(1 - z * z);
      direction = Vector3d(width * std::cos(angle), width * std::sin(angle), z);
    }
    graph.edge(centre, graph.node(length * direction, radius));
  }
  return graph.graph();
}

CurveSkeleton letter_h(double height, double width, double radius) {
  GraphBuilder graph;
  std::array<int, 2> middle{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double x = width * (static_cast<double>(side) - 0.5);
    middle[side] = graph.node(Vector3d(x, 0, 0), radius);
    graph.edge(middle[side], graph.node(Vector3d(x, height / 2, 0), radius));
    graph.edge(middle[side], graph.node(Vector3d(x, -height / 2, 0), radius));
  }
  graph.edge(middle[0], middle[1]);
  return graph.graph();
}

CurveSkeleton ladder(int loops, double width, double radius) {
  GraphBuilder graph;
  std::array<int, 2> last{-1, -1};
  for (int rung = 0; rung <= loops; ++rung) {
    std::array<int, 2> ends{};
    for (std::size_t side = 0; side < 2; ++side) {
      const double y = width * (static_cast<double>(side) - 0.5);
      ends[side] = graph.node(Vector3d(width * (rung - 0.5 * loops), y, 0), radius);
      if (rung > 0) graph.edge(last[side], ends[side]);
    }
    graph.edge(ends[0], ends[1]);
    last = ends;
  }
  return graph.graph();
}

CurveSkeleton ring_chain(int loops, double ring_radius, double radius) {
  GraphBuilder graph;
  if (loops == 0) {
    const int a = graph.node(Vector3d(-ring_radius, 0, 0), radius);
    graph.edge(a, graph.node(Vector3d(ring_radius, 0, 0), radius));
    return graph.graph();
  }
  constexpr int corners = 48;
  int left_of_bar = -1;
  for (int ring = 0; ring < loops; ++ring) {
    const auto first = static_cast<int>(graph.nodes.size());
    const Vector3d centre(3 * ring_radius * (ring - 0.5 * (loops - 1)), 0, 0);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * pi * i / corners;
      graph.node(centre + ring_radius * Vector3d(std::cos(angle), std::sin(angle), 0), radius);
      if (i > 0) graph.edge(first + i - 1, first + i);
    }
    graph.edge(first, first + corners - 1);
    if (left_of_bar >= 0) graph.edge(left_of_bar, first + corners / 2);
    left_of_bar = first;
  }
  return graph.graph();
}

CurveSkeleton tree(int generations, double length, double radius) {
  GraphBuilder graph;
  struct Twig {
    int node;
    Vector3d direction;
    Vector3d spread;  ///< unit, normal to the direction: the plane of the next fork
  };
  const int root = graph.node(Vector3d::Zero(), radius);
  const int fork = graph.node(Vector3d(0, 0, length), radius);
  graph.edge(root, fork);
  std::vector<Twig> twigs = {{fork, Vector3d::UnitZ(), Vector3d::UnitX()}};
  for (int generation = 1; generation <= generations; ++generation) {
    length *= 0.75;
    radius *= 0.8;
    std::vector<Twig> next;
    for (const Twig& twig : twigs) {
      for (const double sign : {-1.0, 1.0}) {
        const Vector3d direction = (twig.direction + sign * 0.9 * twig.spread).normalized();
        const Vector3d from = graph.nodes[static_cast<std::size_t>(twig.node)];
        const int end = graph.node(from + length * direction, radius);
        graph.edge(twig.node, end);
        next.push_back({end, direction, twig.direction.cross(twig.spread).normalized()});
      }
    }
    twigs = std::move(next);
  }
  return graph.graph();
}

CurveSkeleton random_graph(std::uint64_t seed, int nodes, int loops, double radius) {
  Random random(seed);
  for (int attempt = 0; attempt < 2000; ++attempt) {
    GraphBuilder graph;
    if (grow_random(graph, random, nodes, loops, radius)) return graph.graph();
  }
  throw Error(Fault::input, "random graph of " + std::to_string(nodes) + " nodes and " +
                                std::to_string(loops) +
                                " loops: no room for it; ask for fewer loops");
}

}  // namespace curveskel::shapes
