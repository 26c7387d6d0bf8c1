// An order of elimination for sparse symmetric matrices: nested dissection.
#pragma once

#include <functional>
#include <vector>

#include <curveskel/advanced/laplacian.hpp>

namespace curveskel {

/// Unknowns that are eliminated together. Places count along the order of elimination.
struct EliminationNode {
  int first = 0;   ///< place of the subtree's first unknown
  int pivots = 0;  ///< place of the node's own first
  int end = 0;     ///< after its last
  int parent = -1;
  std::vector<int> border;  ///< places >= end that the subtree's unknowns are joined to, ascending

  [[nodiscard]] int pivot_count() const { return end - pivots; }
  [[nodiscard]] int border_count() const { return static_cast<int>(border.size()); }
};

struct EliminationTree {
  std::vector<EliminationNode> nodes;      ///< children before their parents
  std::vector<std::vector<int>> children;  ///< per node, ascending
  std::vector<int> unknown_at;             ///< per place
  std::vector<int> place_of;               ///< per unknown

  /// Subtrees that do not hang on one another, and after them, round by round, the nodes above:
  /// those of one round hang on earlier rounds alone. Does not depend on the number of threads.
  std::vector<std::vector<int>> subtrees;  ///< each with children before parents
  std::vector<std::vector<int>> rounds;    ///< of nodes

  /// Calls visit_node for each node after its children, from at most `threads` threads.
  void visit(int threads, const std::function<void(int node)>& visit_node) const;
};

/// Splits the unknowns by separators that join as few of them as levels of breadth-first search do
/// (A. George, Nested dissection of a regular finite element mesh, 1973), down to a few unknowns.
/// Hubs, unknowns that more than about 10 sqrt(n) others are joined to, come last: a search from
/// anywhere is through with the matrix once it meets one. Precondition: `h` is square, its pattern
/// symmetric. About O(n log n) for surfaces, hubs or not.
[[nodiscard]] EliminationTree dissect(const SparseMatrix& h, int threads);

}  // namespace curveskel
