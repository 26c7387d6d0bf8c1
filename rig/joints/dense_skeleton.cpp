#include <algorithm>
#include <cmath>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/make_rig.hpp>
#include "rig/joints/contacts.hpp"
#include "rig/joints/rooted_tree.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

/// The new nodes of each edge, from its first to its second node.
struct Pieces {
  int first = 0;  ///< new node
  int count = 0;
};

/// The edges in pieces of half a radius, of .002 of the longest side of the box at least.
struct Divided {
  std::vector<Pieces> pieces;             // by edge
  std::vector<Eigen::RowVector4d> added;  // place, radius
  std::vector<Eigen::RowVector2i> edges;
};

Divided divided_edges(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii) {
  constexpr double longest = 0.5;   // radii
  constexpr double finest = 0.002;  // of the longest side of the box
  const double least =
      finest *
      (skeleton.nodes.colwise().maxCoeff() - skeleton.nodes.colwise().minCoeff()).maxCoeff();
  const auto nodes = static_cast<int>(skeleton.nodes.rows());
  Divided made;
  for (const auto& edge : skeleton.edges.rowwise()) {
    const Eigen::RowVector3d from = skeleton.nodes.row(edge[0]);
    const Eigen::RowVector3d to = skeleton.nodes.row(edge[1]);
    const double step = std::max(longest * std::min(radii[edge[0]], radii[edge[1]]), least);
    const int count = static_cast<int>(std::ceil((to - from).norm() / step - 1e-9)) - 1;
    made.pieces.push_back({nodes + static_cast<int>(made.added.size()), std::max(count, 0)});
    int before = edge[0];
    for (int k = 1; k <= count; ++k) {
      const double share = static_cast<double>(k) / (count + 1);
      Eigen::RowVector4d node;
      node << from + share * (to - from), (1 - share) * radii[edge[0]] + share * radii[edge[1]];
      const int number = nodes + static_cast<int>(made.added.size());
      made.added.push_back(node);
      made.edges.emplace_back(before, number);
      before = number;
    }
    made.edges.emplace_back(before, edge[1]);
  }
  return made;
}

/// A vertex goes to the nearest place of the half edges round its node.
void hand_vertices_on(CurveSkeleton& dense, const Surface& surface, const CurveSkeleton& skeleton,
                      const std::vector<Pieces>& pieces) {
  std::vector<std::vector<int>> beside(idx(skeleton.nodes.rows()));
  for (std::size_t e = 0; e < pieces.size(); ++e) {
    for (int k = 0; k < pieces[e].count; ++k) {
      const bool is_first_half = 2 * k + 1 < pieces[e].count + 1;
      const int node = skeleton.edges(static_cast<Eigen::Index>(e), is_first_half ? 0 : 1);
      beside[idx(node)].push_back(pieces[e].first + k);
    }
  }
  for (Eigen::Index v = 0; v < dense.node_of_vertex.size(); ++v) {
    const int given = dense.node_of_vertex[v];
    if (given < 0) continue;
    const Eigen::RowVector3d place = surface.positions.row(v);
    double nearest = (dense.nodes.row(given) - place).squaredNorm();
    for (const int node : beside[idx(given)]) {
      const double distance = (dense.nodes.row(node) - place).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      dense.node_of_vertex[v] = node;
    }
  }
}

}  // namespace

CurveSkeleton dense_skeleton(const Surface& surface, const CurveSkeleton& skeleton,
                             const Monitor& monitor) {
  require_sound_places(skeleton, "dense_skeleton");
  require_vertices_of(skeleton, surface, "dense_skeleton");
  const Eigen::Index nodes = skeleton.nodes.rows();
  if (nodes < 2) return skeleton;
  const Eigen::VectorXd radii = usable_radii(skeleton);
  const Divided made = divided_edges(skeleton, radii);
  CurveSkeleton dense = skeleton;
  const auto all = nodes + static_cast<Eigen::Index>(made.added.size());
  dense.nodes.conservativeResize(all, 3);
  dense.radii = radii;
  dense.radii.conservativeResize(all);
  for (std::size_t k = 0; k < made.added.size(); ++k) {
    const auto row = nodes + static_cast<Eigen::Index>(k);
    dense.nodes.row(row) = made.added[k].head<3>();
    dense.radii[row] = made.added[k][3];
  }
  dense.edges.resize(static_cast<Eigen::Index>(made.edges.size()), 2);
  for (std::size_t k = 0; k < made.edges.size(); ++k) {
    dense.edges.row(static_cast<Eigen::Index>(k)) = made.edges[k];
  }
  hand_vertices_on(dense, surface, skeleton, made.pieces);
  dense.contacts = contacts_of(surface, dense, monitor.stop);
  return dense;
}

}  // namespace curveskel
