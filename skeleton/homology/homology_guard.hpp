// The homology guard: no change of a SkeletonGraph leads a cycle off its handle.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_classes.hpp"

namespace curveskel {

/// The arcs that are left when leaves are taken off until there are none, ascending: all that
/// lie on cycles, and arcs that join these.
[[nodiscard]] std::vector<int> core(const SkeletonGraph& graph);

/// True if a straight line meets the surface, or comes within `near` of it.
[[nodiscard]] bool crosses(const SurfaceTree& tree, const Point& from, const Point& to,
                           double near = 0);

/// Compares graphs before and after a change that leaves arcs and nodes their numbers, and
/// takes back what leads an arc round a handle or off one. Arcs that lie on no cycle may go
/// where they like. A surface without handles costs nothing.
class HomologyGuard {
 public:
  HomologyGuard() = default;  ///< lets everything go where it likes
  /// One closed component. Arcs stay farther than `near` from it where they were. Whatever takes
  /// long throws Cancelled soon after a stop was requested. With the surface's own tree, which is
  /// kept, changes within a point's inscribed ball cost next to nothing.
  explicit HomologyGuard(const Surface& surface, std::stop_token stop = {}, double near = 0,
                         const SurfaceTree* own_tree = nullptr);

  [[nodiscard]] bool has_handles() const { return classes_ && classes_->has_handles(); }

  void hear_stop() const { throw_if_stopped(stop_); }

  [[nodiscard]] bool homologous(const std::vector<Point>& there, const std::vector<Point>& back) {
    return classes_->homologous(there, back);
  }

  /// See HomologyClasses. Precondition: the surface has handles.
  [[nodiscard]] std::uint64_t number(const Point& from, const Point& to) {
    return classes_->number(from, to);
  }

  /// A row for each closed polygon, see HomologyClasses. Precondition: the surface has handles.
  [[nodiscard]] std::vector<BitRow> linking_numbers(
      const std::vector<std::vector<Point>>& polygons) const {
    return classes_->linking_numbers(polygons);
  }

  /// True if each handle has a cycle of the graph. Precondition: the surface has handles.
  [[nodiscard]] bool finds_all_handles(const SkeletonGraph& graph,
                                       const PartitionGraph& partition) const;

  /// Pulls the arcs on cycles taut: of each way the chord stays, as far as it can be drawn round
  /// the same handles with half of the clearance at its ends or more.
  void pull_taut(SkeletonGraph& graph, const SurfaceTree& tree);

  /// Arcs get back all their points, and nodes their places, where an arc's new course is not
  /// `homologous` its old one, or crosses the surface where that did not.
  void restore_arcs(const SkeletonGraph& before, SkeletonGraph& graph, const SurfaceTree& tree);

  /// The same point by point, for a change that leaves each point its number. The arcs that got
  /// something back.
  std::vector<int> restore_points(const SkeletonGraph& before, SkeletonGraph& graph,
                                  const SurfaceTree& tree);

  /// Shrinks an arc to its node `into` at `point`, which must be there or at its other node.
  /// Arcs that ended at the other node first go along the arc if the short way is not homologous.
  void collapse(SkeletonGraph& graph, int arc, int into, const CurvePoint& point);

 private:
  std::optional<HomologyClasses> classes_;
  std::stop_token stop_;
  double near_ = 0;
  const SurfaceTree* own_tree_ = nullptr;
};

}  // namespace curveskel
