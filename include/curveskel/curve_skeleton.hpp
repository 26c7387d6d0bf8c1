// The result: a graph of nodes with radii.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// #E by 2 node indices; i < j in each row, rows sorted, no row twice.
using Edges = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The side of one component where another is nearest.
struct ContactSide {
  int node = -1;          ///< the nearest to the middle of the place
  std::vector<int> tips;  ///< of its curve, if that is a chain, that lie at the place
};

/// The place where the surfaces of two components touch, or come nearest.
struct Contact {
  ContactSide one, other;
  double area = 0;  ///< of the section through which they meet
  double gap = 0;   ///< between them, in model units; 0 where they touch or overlap
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

struct CurveSkeleton {
  Positions nodes;        ///< #N by 3, in model units
  Edges edges;            ///< #E by 2
  Eigen::VectorXd radii;  ///< #N distances to the surface (0 for a node outside), or empty;
                          ///< what closes holes that the curve goes on to is no surface
  Eigen::VectorXi node_of_vertex;  ///< #V of the surface: the node that each vertex collapsed to
                                   ///< (-1 = the vertex is on no component), or empty
  Eigen::VectorXd lives = {};      ///< #N: of a tip how clearly the surface has it there (see
                                   ///< `tip_lives`), 0 = not at all, and of other nodes; or empty
  std::vector<Contact> contacts = {};  ///< of two components each, or empty: see `dense_skeleton`
};

/// A maximal chain of edges whose inner nodes have degree 2; first == last for a closed chain.
struct Branch {
  std::vector<int> nodes;  ///< in order along the branch, ends included
};

/// Every edge lies in exactly one branch; a cycle without a junction is one closed branch that
/// starts at its lowest node; a node without an edge is in none. A branch starts at its lower end,
/// towards the lower neighbour if it is closed; branches are sorted by their first two nodes.
/// Precondition: `edges` are as described at Edges. O(#N + #E log #E).
[[nodiscard]] std::vector<Branch> branches(const CurveSkeleton& skeleton);

/// #E: the number of the branch that each edge lies in. Throws Error(Fault::input) where edges are
/// not sorted. O(#N + #E log #E).
[[nodiscard]] std::vector<int> branch_of_edges(const CurveSkeleton& skeleton);

/// The row of `edges` between two nodes, -1 if there is none. O(log #E).
[[nodiscard]] int edge_between(const CurveSkeleton& skeleton, int a, int b);

struct GraphTopology {
  int components = 0;
  int cycle_rank = 0;  ///< #E - #N + components
  int tips = 0;        ///< nodes of degree 1
  int junctions = 0;   ///< nodes of degree >= 3
};

/// Of each node, numbered by the lowest node in each. O(#N + #E log #N).
[[nodiscard]] std::vector<int> component_of_node(const CurveSkeleton& skeleton);

/// Nodes without an edge count as components. Precondition: edge rows index into `nodes`.
/// O(#N + #E log #N).
[[nodiscard]] GraphTopology graph_topology(const CurveSkeleton& skeleton);

}  // namespace curveskel
