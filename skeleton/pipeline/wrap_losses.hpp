// The verdict on a wrap by the surface that it stands for.
#pragma once

#include <string>

#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/pipeline/failing_components.hpp"

namespace curveskel {

/// In one line, the reason why a curve that was extracted from a wrap may not take the place of the
/// component's own; empty if it may. It may not lie outside of the component for a larger share of
/// its length (it runs between limbs that the wrap has joined), nor lose limbs: leave parts of the
/// component far that the component's own curve comes near to.
[[nodiscard]] std::string losses_by_wrap(const FailingComponent& failing,
                                         const CurveSkeleton& from_wrap,
                                         const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel
