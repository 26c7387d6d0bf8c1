// The verdict on wraps that are about to take the place of components.
#pragma once

#include <vector>

#include <curveskel/extract_repaired.hpp>
#include "surface/repair/wrap_components.hpp"

namespace curveskel {

/// True if the certificate holds, or fails for other components than the wraps. A wrap's own
/// certificate held while the wrap was alone, which does not make it hold beside the others.
/// Precondition: `found` was extracted from the surface with the wraps in their places.
[[nodiscard]] bool wraps_hold(const RepairedExtraction& found,
                              const std::vector<ComponentWrap>& wraps,
                              const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel
