// The largest ball inside the surface that touches it, at every vertex.
#pragma once

#include <Eigen/Core>

#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

struct InscribedBalls {
  Positions centres;      ///< #V by 3
  Eigen::VectorXd radii;  ///< #V, model units
};

/// One ball per vertex of `surface` (which may be coarser than the tree's surface). A ball whose
/// centre lies outside, or as large as half of the bounding-box diagonal, comes from a wrong
/// normal: it is replaced by the mean of its neighbours' balls. Cost: one tree query and one inside
/// test per vertex, on `threads` threads (0 = one per core); the result does not depend on their
/// number.
[[nodiscard]] InscribedBalls inscribed_balls(const Surface& surface, const SurfaceTree& tree,
                                             int threads);

}  // namespace curveskel
