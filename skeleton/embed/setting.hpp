// The surface and all else that a SkeletonGraph is held against while it is embedded.
#pragma once

#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/place/spacing.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// One closed component with D = 1. The balls are its vertices'; the partition is the source of the
/// graph.
struct Setting {
  const Surface& surface;
  const SurfaceTree& tree;
  const InscribedBalls& balls;
  const PartitionGraph& partition;
  const EmbedOptions& options;
  const EmbedTuning& tuning;
  Spacing spacing;
  int threads;
  HomologyGuard& guard;
};

}  // namespace curveskel
