// Another try of components whose certificate fails: without their small handles.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include <curveskel/repair.hpp>
#include "skeleton/pipeline/extraction_plans.hpp"

namespace curveskel {

/// Of each component that fails and has handles, the small ones are cut (see `small_handle`). Those
/// whose certificate holds then stand in their places while the whole is extracted. Gives up where
/// there are none.
[[nodiscard]] Extracted extracted_without_small_handles(const RepairedSurface& repaired,
                                                        const ExtractOptions& options,
                                                        const Plan<Extracted>::Room& given);

/// Of a surface with many handles, most of them small, a hint that they may be noise; else nothing.
[[nodiscard]] std::optional<std::string> hint_at_small_handles(const Surface& surface, int genus,
                                                               const std::stop_token& stop);

}  // namespace curveskel
