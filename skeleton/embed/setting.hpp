// The surface and all else that a SkeletonGraph is held against while it is embedded.
#pragma once

#include <stop_token>
#include <vector>

#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/place/mirror.hpp"
#include "skeleton/embed/place/spacing.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/embed/working_surface.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// One closed component with D = 1; the partition is the source of the graph.
struct Setting {
  const WorkingSurface& working;
  const SurfaceTree& tree;      ///< distances and what lies inside are asked of it
  const SurfaceTree& sections;  ///< cross-sections are; that of the working surface fits the cache
  const PartitionGraph& partition;
  const EmbedOptions& options;
  const EmbedTuning& tuning;
  Spacing spacing;
  int threads;
  HomologyGuard& guard;
  std::vector<MirrorPlane> mirror_planes;  ///< of the surface
  std::stop_token stop = {};               ///< asked in all loops that may take long
  const Surface* full = nullptr;           ///< the surface of `tree`, null if it is not known
  bool needs_all_handles = false;          ///< else the first course makes do with those it finds
};

}  // namespace curveskel
