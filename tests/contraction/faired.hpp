// Surfaces and comparisons for the laws of the local flow.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/fair.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {

inline std::vector<shapes::Shape> noisy_and_clean_shapes() {
  const auto tube = shapes::tube("tube", shapes::s_curve(6, 2), shapes::wavy(0.5, 0.1, 3), 14);
  const auto ball = shapes::ellipsoid({1, 1.5, 2}, 3);
  const auto box = shapes::box({1, 2, 3}, 8);
  return {tube,
          shapes::noisy(tube, 0.02, 1),
          ball,
          shapes::noisy(ball, 0.02, 2),
          box,
          shapes::renumbered(shapes::torus(2, 0.6, 12), 3),
          shapes::linked_rings(2, 0.4, 10),
          shapes::cone(1, 2, 40)};
}

/// Of corresponding vertices, over the bounding box's diagonal.
inline double largest_difference(const Surface& a, const Surface& b) {
  return ((a.positions - b.positions) / bounding_box_diagonal(b.positions))
      .rowwise()
      .norm()
      .maxCoeff();
}

inline FairOptions with(FairMethod method, int iterations, bool double_precision = false) {
  FairOptions options;
  options.method = method;
  options.iterations = iterations;
  options.double_precision = double_precision;
  return options;
}

}  // namespace curveskel

#define SKIP_WITHOUT_DEVICE() \
  if (devices().empty()) GTEST_SKIP() << "no OpenCL device on this machine"
