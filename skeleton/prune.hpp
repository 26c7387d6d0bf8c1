// Which branches mean something.
#pragma once

#include <vector>

#include "skeleton/circles.hpp"
#include "skeleton/network.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// The surface that belongs to the graph: each group's vertices, and the neck at each circle.
struct Regions {
  struct Neck {
    Point centre;
    double radius;  ///< mean distance of the circle's points from their centre, model units
  };
  int groups = 0;
  std::vector<std::vector<int>> vertices;  ///< per group
  std::vector<Neck> necks;                 ///< per circle
};
[[nodiscard]] Regions regions_of(const Surface& surface, const VertexGraph& graph);

/// Height of what lies beyond a neck over the neck's radius, for the most favourable neck of a leaf
/// strand: about 1 for a hemisphere or the corner of a box, more for whatever sticks out.
[[nodiscard]] double slenderness(const Network& network, int strand, const Surface& surface,
                                 const Regions& regions);

/// Prunes leaf strands whose slenderness is below the limit, least first, as long as something is
/// left.
void prune_blunt(Network& network, const Surface& surface, const Regions& regions, double limit);

/// Prunes leaf strands shorter than `factor` x the inscribed radius at their junction, shortest
/// ratio first. Returns whether any was.
bool prune_spurs(Network& network, const SurfaceTree& tree, double factor);

}  // namespace curveskel
