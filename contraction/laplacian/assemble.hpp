// Edge weights to a compressed Laplacian.
#pragma once

#include <utility>
#include <vector>

#include <curveskel/advanced/laplacian.hpp>
#include "contraction/laplacian/intrinsic_delaunay.hpp"

namespace curveskel {

/// Counting sort instead of triplets; keeps its arrays between calls.
class LaplacianAssembly {
 public:
  /// L_ij = sum of the weights of i-j, L_ii = -sum_j L_ij; every diagonal entry is stored.
  /// O(#edges + #V), columns sorted.
  void assemble(const std::vector<WeightedEdge>& edges, int vertices, SparseMatrix& laplacian);

 private:
  std::vector<int> start_;
  std::vector<std::pair<int, double>> entries_;
};

}  // namespace curveskel
