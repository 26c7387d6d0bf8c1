#pragma once

#include <cmath>

#include "meshes/shapes.hpp"

namespace curveskel {

/// Rings in a row, each smaller than the last: from one end to the other by `ratio`.
inline shapes::Shape dwindling_rings(int rings, double ratio) {
  shapes::Shape shape =
      shapes::tube_union("dwindling-rings", shapes::ring_chain(rings, 2.2, 1), {0.25, 1.7});
  auto& positions = shape.surface.positions;
  const double low = positions.col(0).minCoeff();
  const double rate = std::log(ratio) / (positions.col(0).maxCoeff() - low);
  for (auto p : positions.rowwise()) {
    const double scale = std::exp(rate * (p.x() - low));
    p << scale / rate, scale * p.y(), scale * p.z();
  }
  shape.axis = {};
  return shape;
}

}  // namespace curveskel
