#include "rig/gltf/seam_normals.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>

namespace curveskel {

Positions normals_across_seams(const Surface& surface) {
  Positions normals = vertex_normals(surface);
  const auto place = [&](int vertex) {
    const auto point = surface.positions.row(vertex);
    return std::tuple(point.x(), point.y(), point.z());
  };
  std::vector<int> order(idx(normals.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (end = first; end < order.size() && place(order[end]) == place(order[first]); ++end) {
      sum += normals.row(order[end]);
    }
    if (end - first == 1 || sum.norm() < 0.1) continue;  // two sides of a sheet keep theirs
    for (std::size_t k = first; k < end; ++k) normals.row(order[k]) = sum.normalized();
  }
  for (auto normal : normals.rowwise()) {
    const bool usable = normal.allFinite() && normal.squaredNorm() > 0.5;
    if (!usable) normal << 0, 0, 1;
  }
  return normals;
}

}  // namespace curveskel
