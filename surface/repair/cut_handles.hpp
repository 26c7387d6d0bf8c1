// Handles too small to be part of the shape, as scanners and volumes leave them by the dozen.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A surface without its small handles.
struct CutSurface {
  Surface surface;  ///< the vertices given in their order, then those that the cuts added
  std::int64_t handles_cut = 0;
  double longest_loop = 0;              ///< of those along which it was cut
  std::vector<std::int32_t> on_a_loop;  ///< vertices that moved, as a cut went through them
};

/// Cuts the surface along loops of edges no longer than `longest` that do not part it (see
/// `short_loops`), if it opens out on both sides of them (see `opens_out`), and closes both sides
/// by fans: a short bridge becomes two stumps, a short tunnel two pits. Each cut takes one handle.
/// Wires and deep holes do not open out, and stay. Vertices beside a cut move away from it by a
/// quarter of their edges, so that its sides do not touch. Precondition: closed oriented
/// 2-manifold. Throws Cancelled on a stop. O(n log n) for each round, of which there are few:
/// handles that share a vertex wait for the next one.
[[nodiscard]] CutSurface cut_handles(const Surface& surface, double longest,
                                     const std::stop_token& stop = {});

/// The length of loops, of a component's extent, up to which handles are cut where its certificate
/// fails: holes of a hundredth of the extent, as the narrowest wrap closes them. Bars of railings
/// have loops of .05.
inline constexpr double small_handle = 0.03;

/// `cut_handles` up to `small_handle` of the extent.
[[nodiscard]] CutSurface without_small_handles(const Surface& component,
                                               const std::stop_token& stop);

/// A component, by its number in `topology`, and what is left of it.
struct ComponentCut {
  int component = 0;
  CutSurface cut;
};

/// The surface with these in the place of their components. All vertices keep their numbers; rims
/// of holes that a cut went through are rims no more. Counted and said in `repairs`. Precondition:
/// each component at most once.
[[nodiscard]] RepairedSurface with_handles_cut(const RepairedSurface& repaired,
                                               const std::vector<ComponentCut>& cuts,
                                               const Monitor& monitor);

/// Cuts the handles of the whole surface, as RepairOptions::least_handle says; counted, not said.
void cut_small_handles(RepairedSurface& repaired, double least_handle, const std::stop_token& stop);

}  // namespace curveskel
