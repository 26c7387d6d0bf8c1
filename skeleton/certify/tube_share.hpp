// The share of a surface that lies near its curve, as the walls of tubes do.
#pragma once

#include <curveskel/surface.hpp>
#include "skeleton/certify/measured_curve.hpp"

namespace curveskel {

/// The share of the surface's area within 2.5 inscribed radii of the curve: those at the curve's
/// nearest point. By 2,500 points spread evenly over the area, whatever the triangles' sizes; 0
/// without a curve. Deterministic; some microseconds per point. Throws Cancelled on a stop.
[[nodiscard]] double tube_share(const MeasuredCurve& curve, const Surface& surface,
                                const Monitor& monitor);

/// The certificate's `tube_share` and nothing else of it, for a fraction of the time.
[[nodiscard]] double tube_share(const Surface& surface, const CurveSkeleton& skeleton,
                                const CertificateOptions& options, const Monitor& monitor = {});

}  // namespace curveskel
