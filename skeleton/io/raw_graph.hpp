// The content of a skeleton file, before it is a skeleton.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct RawGraph {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::vector<Eigen::RowVector3d> points;
  std::vector<double> radii;               ///< per point; `unknown` where the file has none
  std::vector<double> lives;               ///< the same, as in CurveSkeleton
  std::vector<std::pair<int, int>> edges;  ///< any order, repeats and loops allowed
  std::vector<int> alone;                  ///< points that are nodes without needing an edge
  Eigen::VectorXi node_of_vertex;          ///< as in CurveSkeleton; only with Joining::nothing
  int root = -1;                           ///< the same; -1 = none

  int add(const Eigen::RowVector3d& point, double radius = unknown, double life = unknown) {
    points.push_back(point);
    radii.push_back(radius);
    lives.push_back(life);
    return static_cast<int>(points.size()) - 1;
  }
  /// A chain through the points, or a point alone if there is only one.
  void add_chain(const std::vector<int>& chain);
};

enum class Joining {
  coincident,  ///< points with equal coordinates are one node, points that no edge needs are
               ///< dropped
  nothing      ///< every point is a node
};

/// Nodes keep the order of the points, edges lose repeats and loops. If only some radii are known
/// the others become 0, if none is `radii` stays empty; the same of lives. O(n log n).
[[nodiscard]] CurveSkeleton skeleton_from(const RawGraph& graph, Joining joining);

[[nodiscard]] RawGraph read_obj_lines(const FileBytes& file);
[[nodiscard]] RawGraph read_ply_edges(const FileBytes& file);
[[nodiscard]] RawGraph read_polylines(const FileBytes& file);
[[nodiscard]] RawGraph read_swc(const FileBytes& file);
[[nodiscard]] RawGraph read_vtp(const FileBytes& file);
[[nodiscard]] RawGraph read_graphml(const FileBytes& file);
[[nodiscard]] RawGraph read_json_graph(const FileBytes& file);

}  // namespace curveskel
