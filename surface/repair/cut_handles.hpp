// Handles too small to be part of the shape, as scanners and volumes leave them by the dozen.
#pragma once

#include <array>
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
  std::vector<std::int32_t> on_a_loop;  ///< the vertices given that moved, as a cut went by them
};

/// Cuts each handle that has two loops of edges no longer than `longest`, one round it and one
/// through it, along the shorter one, and closes both sides by fans: a thin bridge becomes two
/// stumps, a thin tunnel two pits. A long thin handle (a wire) and a deep narrow hole have one such
/// loop only, and stay. The loops are those that leave a tree of shortest ways and come back to it
/// by one edge; of these the shortest that together generate the homology (Erickson and Whittlesey
/// 2005, but lengths count from where the two ways part, as handles are small and the root is far).
/// Vertices beside a cut move away from it by a quarter of their edges, so that its sides don't
/// touch. Precondition: closed oriented 2-manifold. Throws Cancelled on a stop. O(n log n) for each
/// round, of which there are few: handles that share a vertex wait for the next one.
[[nodiscard]] CutSurface cut_handles(const Surface& surface, double longest,
                                     const std::stop_token& stop = {});

/// Lengths of loops, of a component's extent, up to which handles are cut where its certificate
/// fails. From short to long, so that no more is lost than need be.
inline constexpr std::array handle_lengths{0.03, 0.1};

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
