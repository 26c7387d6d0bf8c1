// The part of a certificate that decides.
#pragma once

#include <curveskel/certificate.hpp>

namespace curveskel {

/// All that `Certificate::correct` needs, the numbers of components, cycles and round handles, and
/// how much of the curve is inside; all other figures stay as they are by default. Conditions and
/// errors as of `evaluate`. The figures left out cost thousands of points and rays for the smallest
/// of components, this only what the component has of curve and surface.
[[nodiscard]] Certificate verdict(const CertifiedSurface& surface, const CurveSkeleton& skeleton,
                                  const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel
