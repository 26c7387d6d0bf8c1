// Rotations that lay the middle of one body onto that of another.
#pragma once

#include <cstddef>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/match/similarity.hpp"
#include "skeleton/match/tips.hpp"

namespace curveskel {

struct CoreAlignment {
  Similarity motion;
  double residual =
      0;  ///< distance of a's core, or of all, to b's surface over b's unit: mean, best 80 %
};

/// With b so many times as large as a. The best of the cores first, each 30 degrees or more from
/// all before it, at most `most`; then the same of the whole surfaces, which have a middle even
/// where cycles leave the curve none; then as both stand, as bodies are upright in most files, from
/// where the other starts may fall into a like turn. Starts are the rotations of three limbs of a
/// onto three of b that are as far apart, those of the principal axes, and none; the best are
/// refined by nearest points (P. Besl and N. McKay, A method for registration of 3-D shapes, 1992).
/// `tree_b` is over b's surface. Throws Cancelled on a stop.
[[nodiscard]] std::vector<CoreAlignment> align_cores(const MatchedBodies& bodies,
                                                     const SurfaceTree& tree_b, double scale,
                                                     std::size_t most, const MatchOptions& options,
                                                     const std::stop_token& stop);

}  // namespace curveskel
