// The embedding with other constants than the usual ones, for the test that moves each of them.
#pragma once

#include <functional>

#include <curveskel/advanced/embed.hpp>
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// The surface that a working surface was coarsened from. Kept by reference.
struct FullSurface {
  std::function<const SurfaceTree&()> tree;  ///< called once, half-way: it may grow till then
  const Surface* surface = nullptr;          ///< the tree's; null if it is not known
};

/// See `embed`.
[[nodiscard]] CurveSkeleton embed_tuned(const Surface& surface, const SurfaceTree& tree,
                                        const FullSurface& full, const InscribedBalls& balls,
                                        const PartitionGraph& partition,
                                        const EmbedOptions& options, const EmbedTuning& tuning,
                                        int threads, StepClock& clock, const Monitor& monitor);

}  // namespace curveskel
