#include "surface/mesh/loose_parts.hpp"

#include <Eigen/Geometry>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {

LooseParts loose_parts(const Surface& surface) {
  UnionFind joined(surface.positions.rows());
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 1; k < 3; ++k) joined.unite(t(0), t(k));
  }
  LooseParts parts;
  std::vector<int> number(idx(surface.positions.rows()), -1);
  for (const auto& t : surface.triangles.rowwise()) {
    int& part = number[idx(joined.root(t(0)))];
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
