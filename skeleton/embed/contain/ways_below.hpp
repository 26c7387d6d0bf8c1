// Ways that keep just below the triangles of a surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"
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
  /// not among the places that may be looked at for all ways together, a million. Precondition:
  /// both points inside. O(m log m) for the m edges as near as the other point. Throws Cancelled if
  /// a stop was requested.
  [[nodiscard]] std::optional<std::vector<Point>> between(const CurvePoint& from,
                                                          const CurvePoint& to);

  /// The same by the shortest of those ways that go round different handles that `is_good` takes.
  /// Of ways round many handles there are too many: nothing, either, if none of the 20 shortest is
  /// good, or these are not found among 300,000 places.
  /// Precondition: the handles' surface has handles, and `handles` is the same for all ways.
  using IsGood = std::function<bool(const std::vector<Point>& way)>;
  [[nodiscard]] std::optional<std::vector<Point>> between(const CurvePoint& from,
                                                          const CurvePoint& to,
                                                          HomologyGuard& handles,
                                                          const IsGood& is_good);

 private:
  /// A half-edge and the sum of the handles' numbers on the way to it, see HomologyClasses.
  struct Place {
    std::int32_t half_edge = -1;
    std::uint64_t number = 0;
    [[nodiscard]] bool operator==(const Place&) const = default;
    [[nodiscard]] bool operator<(const Place& other) const {
      return std::pair(half_edge, number) < std::pair(other.half_edge, other.number);
    }
  };
  struct HashOfPlace {
    std::size_t operator()(const Place& place) const {
      return static_cast<std::size_t>(place.half_edge) ^ place.number;
    }
  };
  /// From the middle of an edge to that of another one of the same face.
  struct KnownStep {
    std::optional<std::uint64_t> number;
    std::optional<bool> is_inside;
  };
  /// The ends of a way, below their triangles, and what is wanted of it.
  struct Task {
    SurfaceTree::Nearest from;
    SurfaceTree::Nearest to;
    Point start = Point::Zero();
    Point end = Point::Zero();
    HomologyGuard* handles = nullptr;  ///< none if handles are all one
    const IsGood* is_good = nullptr;   ///< none if any way will do
  };

  [[nodiscard]] std::optional<std::vector<Point>> way_for(const CurvePoint& from,
                                                          const CurvePoint& to,
                                                          HomologyGuard* handles,
                                                          const IsGood* is_good);
  [[nodiscard]] std::optional<std::vector<Point>> search(const Task& task);
  [[nodiscard]] std::vector<Point> line_of(const Task& task,
                                           const std::vector<std::int32_t>& edges) const;
  void pair_edges();
  /// Of steps between half-edges; -1 = one of the task's two points.
  [[nodiscard]] std::uint64_t number_of_step(const Task& task, std::int32_t from, std::int32_t to);
  [[nodiscard]] bool stays_inside(const Task& task, std::int32_t from, std::int32_t to);
  [[nodiscard]] std::pair<Point, Point> ends_of_step(const Task& task, std::int32_t from,
                                                     std::int32_t to) const;
  [[nodiscard]] KnownStep& known_of(std::int32_t from, std::int32_t to);
  [[nodiscard]] Point below(std::int32_t face, const Point& place) const;
  [[nodiscard]] Point below_edge(std::int32_t half_edge) const;
  [[nodiscard]] Point middle(std::int32_t half_edge) const;

  const Surface& surface_;
  const SurfaceTree& tree_;
  std::stop_token stop_;
  std::optional<HalfEdges> half_edges_;  // made when first asked for
  // Two from each half-edge across the face beyond it, which a search may take several times.
  std::vector<KnownStep> steps_;
  // For all ways, as a surface may meet itself everywhere.
  std::int64_t more_places_ = 1000000;
};

}  // namespace curveskel
