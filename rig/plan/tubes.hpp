// The parts of a body that are made of tubes, asked one by one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

/// A point of the surface and the node of the curve next to it.
struct PointOfNode {
  Eigen::Vector3d point;
  int node;
};

/// An eighth of those that a certificate asks, evenly over the area. Near-linear in #N.
[[nodiscard]] std::vector<PointOfNode> points_by_nodes(const CurveTree& tree);

/// True on the wall of a tube, as by a certificate's `tube_share`.
[[nodiscard]] bool is_near_curve(const CurveTree& tree, const PointOfNode& at);

/// Of the surface about the nodes that count the share that lies near them; 0 if there is none.
[[nodiscard]] double tubes_among(const CurveTree& tree, const std::function<bool(int)>& counts);

}  // namespace curveskel
