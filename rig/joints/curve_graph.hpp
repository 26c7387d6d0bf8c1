// A skeleton's nodes with their neighbours. Internal to rig/.
#pragma once

#include <Eigen/Core>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

/// Refers to the skeleton.
struct CurveGraph {
  const CurveSkeleton& skeleton;
  Graph graph;

  explicit CurveGraph(const CurveSkeleton& of)
      : skeleton(of), graph(graph_of(of.nodes.rows(), of.edges)) {}

  [[nodiscard]] Eigen::Vector3d point(int node) const {
    return skeleton.nodes.row(node).transpose();
  }
  [[nodiscard]] int degree(int node) const { return graph.degree(node); }

  /// The next node of a chain, -1 where it ends.
  [[nodiscard]] int beyond(int before, int node) const {
    if (degree(node) != 2) return -1;
    const auto both = graph.neighbours(node);
    return both[both[0] == before ? 1 : 0];
  }
};

}  // namespace curveskel
