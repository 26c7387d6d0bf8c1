// The largest ball inside the surface that touches it, at every vertex.
#pragma once

#include <Eigen/Core>
#include <stop_token>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct InscribedBalls {
  Positions centres;      ///< #V by 3
  Eigen::VectorXd radii;  ///< #V, model units
};

/// One ball per vertex of `surface` (which may be coarser than the tree's surface: where a vertex
/// lies outside that one, as those of a coarse convex surface do, its ball touches the nearest
/// point of it). A ball whose centre lies outside, or as large as half of the bounding-box
/// diagonal, comes from a wrong normal: it is replaced by the mean of its neighbours' balls. Cost:
/// one tree query and one inside test per vertex, on `threads` threads (0 = one per core); the
/// result does not depend on their number. Throws Cancelled soon after a stop was requested.
[[nodiscard]] InscribedBalls inscribed_balls(const Surface& surface, const SurfaceTree& tree,
                                             int threads, const std::stop_token& stop = {});

/// #V by 3: each centre moved to the mean of its neighbours', this many times. They are no centres
/// of inscribed balls any more, but hang less on single vertices.
[[nodiscard]] Positions smoothed_centres(const Surface& surface, const InscribedBalls& balls,
                                         int rounds);

}  // namespace curveskel
