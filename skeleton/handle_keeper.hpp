// Whatever is done to a network, each of its cycles goes round the handle that it went round.
#pragma once

#include <optional>
#include <vector>

#include "skeleton/circles.hpp"
#include "skeleton/linking.hpp"
#include "skeleton/network.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// The strands that are left when leaves are taken off until there are none, ascending: all that
/// lie on cycles, and what joins these.
[[nodiscard]] std::vector<int> core(const Network& network);

/// Whether a straight line meets the surface.
[[nodiscard]] bool crosses(const SurfaceTree& tree, const Point& from, const Point& to);

/// Compares networks before and after a change that leaves strands and hubs their numbers, and
/// takes back what leads a strand round a handle or off one. Strands that lie on no cycle may go
/// where they like. A surface without handles costs nothing.
class HandleKeeper {
 public:
  HandleKeeper() = default;                       ///< lets everything go where it likes
  explicit HandleKeeper(const Surface& surface);  ///< one closed component

  [[nodiscard]] bool has_handles() const { return classes_ && classes_->has_handles(); }

  [[nodiscard]] bool alike(const std::vector<Point>& there, const std::vector<Point>& back) {
    return classes_->alike(there, back);
  }

  /// Pulls the strands on cycles taut: of each way the chord stays, as far as it can be drawn round
  /// the same handles with half of the clearance at its ends or more.
  void pull_taut(Network& network, const SurfaceTree& tree);

  /// Strands get back all their points, and hubs their places, where a strand's new course is not
  /// `alike` its old one, or crosses the surface where that did not.
  void restore_strands(const Network& before, Network& network, const SurfaceTree& tree);

  /// The same point by point, for a change that leaves each point its number. The strands that got
  /// something back.
  std::vector<int> restore_points(const Network& before, Network& network, const SurfaceTree& tree);

  /// Shrinks a strand to its hub `into` at `position`, which must be there or at its other hub.
  /// What ended at that one first goes along the strand where the short way would not be alike.
  void collapse(Network& network, int strand, int into, const Point& position);

 private:
  std::optional<HandleClasses> classes_;
};

/// Whether each handle has a cycle of its own.
[[nodiscard]] bool goes_round_all_handles(const Network& network, const VertexGraph& graph,
                                          const Surface& surface);

}  // namespace curveskel
