// One extraction at several levels, as `extract --levels` writes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/advanced/embed.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include "app/report.hpp"

namespace curveskel {

/// A detail that was chosen and has no effect.
[[nodiscard]] std::optional<std::string> detail_finding(const EmbedOptions& embed);

struct ExtractionLevel {
  SkeletonLevel level;
  Extraction extraction;  ///< with the level's skeleton and its own certificate
};

/// At most `most`, the finest first; fewer where the lives of the branches tell fewer apart. Throws
/// Cancelled on a stop.
[[nodiscard]] std::vector<ExtractionLevel> levels_of(const RepairedSurface& repaired,
                                                     const Extraction& extraction,
                                                     const CertificateOptions& options, int most,
                                                     const Monitor& monitor);

}  // namespace curveskel
