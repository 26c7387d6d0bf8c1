// From a repaired surface to a skeleton whose certificate holds, if any try gives one.
#pragma once

#include <optional>

#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

struct RepairedExtraction {
  Extraction extraction;
  /// The surface of the extraction, if it is not the surface given.
  std::optional<RepairedSurface> repaired_again;
};

/// `extract`, with the rims of the holes that were closed. If the certificate fails (topology, or
/// too much outside) and `as_repaired.wrap` is `needed`, components that fail are repaired again:
///
/// 1. Of those with handles the small ones are cut (see RepairOptions::least_handle), with loops up
///    to .03 of the component's extent, if the certificate of what is left then holds.
/// 2. If it still fails, those are wrapped (see `Wrapping`) that cross themselves and have a wrap
///    whose certificate holds on its own and whose curve loses nothing of the component: neither
///    runs outside of it nor leaves limbs out. Each wrap has a budget of vertices.
///
/// Either is the result if what is extracted has a certificate that holds, for the whole or at
/// least for each of these components beside others that nothing helps, and is no worse than that
/// of the surface given. Else the surface given stays, with its certificate that fails. Times and
/// history are of all tries; a note says what was done, and where a surface keeps eight handles or
/// more of which most are small. Throws Error(Fault::solver) when a component cannot be contracted,
/// Cancelled on a stop.
[[nodiscard]] RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                                  const RepairOptions& as_repaired = {},
                                                  const ExtractOptions& options = {},
                                                  const Monitor& monitor = {});

/// The same, with the stages of the surface given taken from `cache`; what is repaired again is
/// repaired and extracted each time.
[[nodiscard]] RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                                  const RepairOptions& as_repaired,
                                                  const ExtractOptions& options,
                                                  const Monitor& monitor, ExtractionCache& cache);

/// The same skeleton with a vertex map of the file's vertices instead of the surface's; -1 = the
/// vertex was dropped. O(#V + #N).
[[nodiscard]] CurveSkeleton on_input_vertices(const RepairedSurface& repaired,
                                              CurveSkeleton skeleton);

}  // namespace curveskel
