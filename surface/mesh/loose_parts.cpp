#include "surface/mesh/loose_parts.hpp"

#include <Eigen/Geometry>
#include <numeric>
#include <utility>

#include "base/indices.hpp"

namespace curveskel {

LooseParts loose_parts(const Surface& surface) {
  std::vector<int> parent(idx(surface.positions.rows()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int v) {
    while (parent[idx(v)] != v) v = parent[idx(v)] = parent[idx(parent[idx(v)])];
    return v;
  };
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 1; k < 3; ++k) parent[idx(root(t(k)))] = root(t(0));
  }
  LooseParts parts;
  std::vector<int> number(parent.size(), -1);
  for (const auto& t : surface.triangles.rowwise()) {
    int& part = number[idx(root(t(0)))];
    if (part < 0) {
      part = static_cast<int>(parts.areas.size());
      parts.areas.push_back(0);
    }
    parts.part_of_face.push_back(part);
    const Eigen::RowVector3d a = surface.positions.row(t(0));
    const Eigen::RowVector3d u = surface.positions.row(t(1)) - a;
    const Eigen::RowVector3d v = surface.positions.row(t(2)) - a;
    parts.areas[idx(part)] += u.cross(v).norm() / 2;
  }
  return parts;
}

}  // namespace curveskel
