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
  std::optional<RepairedSurface> wrapped;
};

/// `extract`, with the openings that were closed. If the certificate fails (topology, or too much
/// outside) and `as_repaired.wrap` is `needed`: the components that fail are wrapped (see
/// `Wrapping`), and if the certificate of what is extracted from the wraps holds, this is the
/// result. Then `extraction` has the times of all tries, and a note names the wrapped components.
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
