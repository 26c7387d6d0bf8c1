#include "surface/mesh/loose_parts.hpp"

#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {

LooseParts loose_parts(const Surface& surface) {
  UnionFind joined(surface.positions.rows());
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 1; k < 3; ++k) joined.unite(t(0), t(k));
  }
  LooseParts parts;
  std::vector<int> number(idx(surface.positions.rows()), -1);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    int& part = number[idx(joined.root(surface.triangles(face, 0)))];
    if (part < 0) {
      part = static_cast<int>(parts.areas.size());
      parts.areas.push_back(0);
    }
    parts.part_of_face.push_back(part);
    parts.areas[idx(part)] += twice_area(surface, face) / 2;
  }
  return parts;
}

}  // namespace curveskel
