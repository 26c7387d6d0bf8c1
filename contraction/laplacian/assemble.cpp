#include "contraction/laplacian/assemble.hpp"

#include <algorithm>

namespace curveskel {

void LaplacianAssembly::assemble(const std::vector<WeightedEdge>& edges, int vertices,
                                 SparseMatrix& laplacian) {
  // Each column: one diagonal entry and one per edge at it; parallel edges are summed below.
  start_.assign(vertices + 1, 0);
  for (const auto& edge : edges) {
    ++start_[edge.i + 1];
    ++start_[edge.j + 1];
  }
  for (int v = 0; v < vertices; ++v) start_[v + 1] += start_[v] + 1;
  entries_.resize(start_[vertices]);
  for (int v = 0; v < vertices; ++v) entries_[start_[v]++] = {v, 0.0};
  for (const auto& edge : edges) {
    entries_[start_[edge.i]++] = {edge.j, edge.weight};
    entries_[start_[edge.j]++] = {edge.i, edge.weight};
  }

  laplacian.resize(vertices, vertices);
  laplacian.resizeNonZeros(static_cast<Eigen::Index>(entries_.size()));
  int* outer = laplacian.outerIndexPtr();
  int* inner = laplacian.innerIndexPtr();
  double* values = laplacian.valuePtr();
  int filled = 0;
  for (int v = 0; v < vertices; ++v) {
    const auto first = entries_.begin() + (v == 0 ? 0 : start_[v - 1]);
    const auto last = entries_.begin() + start_[v];
    double sum = 0;
    for (auto entry = first; entry != last; ++entry) sum += entry->second;
    first->second = -sum;
    std::sort(first, last, [](const auto& a, const auto& b) { return a.first < b.first; });
    outer[v] = filled;
    for (auto entry = first; entry != last; ++entry) {
      if (filled > outer[v] && inner[filled - 1] == entry->first) {
        values[filled - 1] += entry->second;
      } else {
        inner[filled] = entry->first;
        values[filled++] = entry->second;
      }
    }
  }
  outer[vertices] = filled;
  laplacian.resizeNonZeros(filled);
}

}  // namespace curveskel
