#include "skeleton/cut/as_contracted.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "skeleton/cut/cgal_surgery.hpp"
#include "skeleton/cut/level_set_graph.hpp"

namespace curveskel {
namespace {

CurveSkeleton skeleton_of(const PartitionGraph& graph, const Positions& positions) {
  return {middles_of_groups(graph, positions), graph.edges, {}, graph.group_of_vertex};
}

SkeletonAsContracted skeleton_of_level_sets(const Surface& surface, const Monitor& monitor) {
  const LevelSetGraph level_sets = level_set_graph(surface, monitor);
  CurveSkeleton skeleton = skeleton_of(level_sets.graph, level_sets.surface.positions);
  const Eigen::VectorXi of_input = skeleton.node_of_vertex(level_sets.vertex_of_input);
  skeleton.node_of_vertex = of_input;
  return {std::move(skeleton), true};
}

}  // namespace

SkeletonAsContracted skeleton_as_contracted(const Surface& surface, const Contraction& contraction,
                                            const SurgeryOptions& options, const Monitor& monitor) {
  if (options.method == SurgeryMethod::cgal) return {cgal_surgery(contraction)};
  const auto graph = surgery(surface, contraction, options, monitor);
  if (!graph) return skeleton_of_level_sets(surface, monitor);
  return {
      skeleton_of(*graph, contraction.surface.positions(contraction.vertex_of_input, Eigen::all))};
}

Eigen::VectorXd inscribed_radii(const Positions& nodes, const SurfaceTree& tree) {
  Eigen::VectorXd radii(nodes.rows());
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    radii[n] = std::max(0.0, tree.inscribed_radius(nodes.row(n)));
  }
  return radii;
}

}  // namespace curveskel
