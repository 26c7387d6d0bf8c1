// The verdict on a wrap by the surface that it stands for.
#pragma once

#include <string>

#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/pipeline/failing_components.hpp"

namespace curveskel {

/// In one line, the reason why a curve that was extracted from a wrap may not take the place of the
/// component's own; empty if it may. It may not join or lose limbs: each tip of the component's own
/// curve, if its branch is inside and reaches 5 % of the component's extent beyond the ball at its
/// other end, needs a tip of the other for itself, beside it; or the other has to cover the
/// component's own vertices as well as its own curve does, but for 10 % of them.
[[nodiscard]] std::string losses_by_wrap(const FailingComponent& failing,
                                         const CurveSkeleton& from_wrap,
                                         const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel
