// The level set of tubes round a graph's edges, melted together where branches meet.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/error.hpp>
#include "meshes/level_set.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

using Eigen::Vector3d;

template <typename Links>
int components_of(Eigen::Index nodes, const Links& links) {
  const std::vector<int> component = connected_components(nodes, links);
  return component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
}

// Edges grouped by branch: those that share a node of degree 2 belong together.
std::vector<std::vector<int>> edges_by_branch(const CurveSkeleton& graph) {
  const auto count = static_cast<int>(graph.edges.rows());
  const std::vector<int> degree = degrees(graph.nodes.rows(), graph.edges);
  UnionFind joined(count);
  std::vector<int> edge_at(degree.size(), -1);
  for (int e = 0; e < count; ++e) {
    for (int k = 0; k < 2; ++k) {
      const auto node = static_cast<std::size_t>(graph.edges(e, k));
      if (degree[node] != 2) continue;
      if (edge_at[node] < 0) {
        edge_at[node] = e;
      } else {
        joined.unite(e, edge_at[node]);
      }
    }
  }
  std::vector<std::vector<int>> groups(static_cast<std::size_t>(count));
  for (int e = 0; e < count; ++e) groups[static_cast<std::size_t>(joined.root(e))].push_back(e);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

double distance_to_tube(const CurveSkeleton& graph, int edge, const Vector3d& p) {
  const int i = graph.edges(edge, 0);
  const int j = graph.edges(edge, 1);
  const Vector3d a = graph.nodes.row(i);
  const Vector3d along = graph.nodes.row(j).transpose() - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm() - (1 - t) * graph.radii[i] - t * graph.radii[j];
}

// A few edges of one branch and a ball round their tubes, to pass over distant ones.
struct Stretch {
  std::vector<int> edges;
  Vector3d centre;
  double reach = 0;
};

std::vector<Stretch> stretches_of(const CurveSkeleton& graph, const std::vector<int>& branch) {
  constexpr std::size_t length = 8;
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first < branch.size(); first += length) {
    const auto begin = branch.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(length, branch.size() - first);
    Stretch stretch{{begin, begin + static_cast<std::ptrdiff_t>(count)}, Vector3d::Zero()};
    Eigen::AlignedBox3d bounds;
    double thickest = 0;
    for (const int node : graph.edges(stretch.edges, Eigen::all).reshaped()) {
      bounds.extend(graph.nodes.row(node).transpose());
      thickest = std::max(thickest, graph.radii[node]);
    }
    stretch.centre = bounds.center();
    stretch.reach = bounds.diagonal().norm() / 2 + thickest;
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

/// The distance to a branch, or `beyond` if that is less.
double distance_to_branch(const CurveSkeleton& graph, const std::vector<Stretch>& branch,
                          const Vector3d& p, double beyond) {
  double nearest = beyond;
  for (const Stretch& stretch : branch) {
    const double limit = nearest + stretch.reach;
    if (limit <= 0 || (p - stretch.centre).squaredNorm() >= limit * limit) continue;
    for (const int e : stretch.edges) nearest = std::min(nearest, distance_to_tube(graph, e, p));
  }
  return nearest;
}

Field field_of(const CurveSkeleton& graph, double melt) {
  std::vector<std::vector<Stretch>> branches;
  for (const auto& branch : edges_by_branch(graph)) branches.push_back(stretches_of(graph, branch));
  return [&graph, melt, branches = std::move(branches)](const Vector3d& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& branch : branches) least = distance_to_branch(graph, branch, p, least);
    if (melt <= 0) return least;
    // A branch as far as that adds less to the sum, which is at least 1, than its last bit.
    const double beyond = least + 45 * melt;
    double sum = 0;
    for (const auto& branch : branches) {
      const double distance = distance_to_branch(graph, branch, p, beyond);
      if (distance < beyond) sum += std::exp((least - distance) / melt);
    }
    return least - melt * std::log(sum);
  };
}

void require_topology(const Shape& shape) {
  const auto& triangles = shape.surface.triangles;
  Eigen::MatrixXi links(triangles.rows() * 2, 2);
  links << triangles.leftCols<2>(), triangles.rightCols<2>();
  const int components = components_of(shape.surface.positions.rows(), links);
  const auto euler = static_cast<int>(shape.surface.positions.rows() - triangles.rows() / 2);
  const int genus = components - euler / 2;
  if (components == shape.components && genus == shape.genus) return;
  throw Error(Fault::input,
              "shape " + shape.name + ": the tubes' surface has " + std::to_string(components) +
                  " components and genus " + std::to_string(genus) + ", the graph " +
                  std::to_string(shape.components) + " and cycle rank " +
                  std::to_string(shape.genus) +
                  "; put tubes that share no node further apart, or raise the resolution");
}

}  // namespace

Shape tube_union(std::string name, const CurveSkeleton& graph, const TubeUnionOptions& options) {
  const double thinnest = graph.radii.minCoeff();
  std::vector<Vector3d> seeds;
  for (Eigen::Index i = 0; i < graph.nodes.rows(); ++i) seeds.emplace_back(graph.nodes.row(i));
  const std::vector<int> degree = degrees(graph.nodes.rows(), graph.edges);

  Shape shape;
  shape.name = std::move(name);
  shape.axis = graph;
  shape.components = components_of(graph.nodes.rows(), graph.edges);
  shape.genus = shape.cycles =
      static_cast<int>(graph.edges.rows() - graph.nodes.rows()) + shape.components;
  shape.tips = static_cast<int>(std::count(degree.begin(), degree.end(), 1));
  shape.junctions =
      static_cast<int>(std::count_if(degree.begin(), degree.end(), [](int d) { return d > 2; }));
  shape.surface = mesh_level_set(field_of(graph, options.blend * thinnest), seeds,
                                 thinnest / options.resolution / 0.6);
  require_topology(shape);
  return shape;
}

Shape random_tubes(int seed) {
  return tube_union("random-seed-" + std::to_string(seed),
                    random_graph(static_cast<std::uint64_t>(seed), 9 + seed % 5, seed % 4, 1),
                    {0.25, 1.7});
}

}  // namespace curveskel::shapes
