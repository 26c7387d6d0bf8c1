// A surface whose handles are lost where it is coarsened.
#pragma once

#include <algorithm>
#include <cmath>

#include <curveskel/surface.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {

/// A sieve with walls this thick, holes of 1, in waves.
inline Surface thin_walled(int holes_along, double wall) {
  Surface surface = shapes::subdivided(shapes::sieve(holes_along)).surface;
  const auto along = [wall](double cells) {
    double length = 0;
    for (int cell = 0; cell < cells; ++cell) {
      length += std::min(cells - cell, 1.0) * (cell % 2 == 0 ? wall : 1);
    }
    return length;
  };
  for (auto row : surface.positions.rowwise()) {
    const double x = along(row.x());
    const double y = along(row.y());
    row << x + 0.15 * std::sin(3 * y), y, row.z() + 0.3 * std::sin(2 * x) * std::cos(2 * y);
  }
  return surface;
}

}  // namespace curveskel
