// From whatever could be repaired to a skeleton whose certificate holds.
#pragma once

#include <optional>

#include "skeleton/extract.hpp"
#include "skeleton/extraction_cache.hpp"
#include "surface/monitor.hpp"
#include "surface/repair.hpp"

namespace curveskel {

struct RepairedExtraction {
  Extraction extraction;
  /// What the extraction is of, where that is not the surface given.
  std::optional<RepairedSurface> wrapped;
};

/// `extract`, with the openings that were closed. If the certificate fails (topology, or too much
/// outside) and `as_repaired.wrap` is `needed`: the components that fail are wrapped (see
/// `Wrapping`), and if the certificate of what is extracted from the wraps holds, this is the
/// result. Then `extraction` has the times of all, and a note says what was done.
/// Throws Error(Fault::solver) when a component cannot be contracted, Cancelled on a stop.
[[nodiscard]] RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                                  const RepairOptions& as_repaired,
                                                  const ExtractOptions& options,
                                                  const Monitor& monitor);

/// The same, with the stages of the surface given taken from `cache`; what is wrapped is wrapped
/// and extracted again each time.
[[nodiscard]] RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                                  const RepairOptions& as_repaired,
                                                  const ExtractOptions& options,
                                                  const Monitor& monitor, ExtractionCache& cache);

}  // namespace curveskel
