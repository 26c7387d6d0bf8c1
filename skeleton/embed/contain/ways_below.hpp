// Ways that keep just below the triangles of a surface.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <stop_token>
#include <utility>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "surface/mesh/half_edges.hpp"

namespace curveskel {

/// The last resort where no chain of inscribed balls stays inside: limbs thinner than the triangles
/// of the working surface are long, pockets where the surface meets itself, balls that were taken
/// from their neighbours. Just below its triangles there is a way, unless the surface goes through
/// itself. BelowSurface follows edges that are given, here the way is sought. D = 1.
class WaysBelow {
 public:
  /// The tree's surface, closed and oriented; both kept by reference.
  WaysBelow(const Surface& surface, const SurfaceTree& tree, std::stop_token stop = {})
      : surface_(surface), tree_(tree), stop_(std::move(stop)) {}

  /// From the nearest triangle of one point to that of the other by the shortest way across edges
  /// that stays inside: its places, without the two points themselves. Nothing if there is none, or
  /// not after a hundred tries to go round places where the surface goes through itself, a thousand
  /// for all ways together. Precondition: both points inside. O(m log m) for the m edges as near as
  /// the other point. Throws Cancelled if a stop was requested.
  [[nodiscard]] std::optional<std::vector<Point>> between(const CurvePoint& from,
                                                          const CurvePoint& to);

 private:
  using Step = std::pair<std::int32_t, std::int32_t>;  // half-edges; -1: one of the two points
  struct Reached {
    double length = 0;
    std::int32_t before = -1;
    bool done = false;
    int search = 0;  // in which it was reached
  };

  [[nodiscard]] std::optional<std::vector<std::int32_t>> edges_between(
      const SurfaceTree::Nearest& from, const SurfaceTree::Nearest& to,
      const std::set<Step>& avoided);
  [[nodiscard]] Point below(std::int32_t face, const Point& place) const;
  [[nodiscard]] Point below_edge(std::int32_t half_edge) const;
  [[nodiscard]] Point middle(std::int32_t half_edge) const;

  const Surface& surface_;
  const SurfaceTree& tree_;
  std::stop_token stop_;
  std::optional<HalfEdges> half_edges_;  // made when first asked for
  std::vector<Reached> reached_;         // the end, then by half-edge
  int searches_ = 0;                     // so far
  int more_fruitless_tries_ = 1000;      // for all ways, as a surface may meet itself everywhere
};

}  // namespace curveskel
