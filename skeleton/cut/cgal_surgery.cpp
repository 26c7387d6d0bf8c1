#include "skeleton/cut/cgal_surgery.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "surface/mesh/cgal_mesh.hpp"

namespace curveskel {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The solver of CGAL's contraction, which is never called.
struct NoSolver {
  struct Matrix;
  struct Vector;
};

using Skeletonization =
    CGAL::Mean_curvature_flow_skeletonization<Mesh, CGAL::Default, CGAL::Default, NoSolver>;
using Graph = Skeletonization::Skeleton;

Positions nodes_of(const Graph& graph) {
  Positions nodes(static_cast<Eigen::Index>(num_vertices(graph)), 3);
  for (const auto node : CGAL::make_range(vertices(graph))) {
    const Kernel::Point_3& p = graph[node].point;
    nodes.row(static_cast<Eigen::Index>(node)) << p.x(), p.y(), p.z();
  }
  return nodes;
}

Edges edges_of(const Graph& graph) {
  std::vector<std::pair<int, int>> found;
  for (const auto edge : CGAL::make_range(boost::edges(graph))) {
    const auto a = static_cast<int>(source(edge, graph));
    const auto b = static_cast<int>(target(edge, graph));
    found.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(found.begin(), found.end());
  Edges edges(static_cast<Eigen::Index>(found.size()), 2);
  for (std::size_t e = 0; e < found.size(); ++e) {
    edges.row(static_cast<Eigen::Index>(e)) << found[e].first, found[e].second;
  }
  return edges;
}

}  // namespace

CurveSkeleton cgal_surgery(const Contraction& contraction) {
  const Mesh mesh = cgal_mesh<Mesh>(contraction.surface);
  Skeletonization skeletonization(mesh);
  Graph graph;
  skeletonization.convert_to_skeleton(graph);
  Eigen::VectorXi node_of_contracted(contraction.surface.positions.rows());
  for (const auto node : CGAL::make_range(vertices(graph))) {
    for (const Mesh::Vertex_index v : graph[node].vertices) {
      node_of_contracted[static_cast<Eigen::Index>(v)] = static_cast<int>(node);
    }
  }
  CurveSkeleton skeleton;
  skeleton.nodes = nodes_of(graph);
  skeleton.edges = edges_of(graph);
  skeleton.node_of_vertex = node_of_contracted(contraction.vertex_of_input);
  return skeleton;
}

}  // namespace curveskel
