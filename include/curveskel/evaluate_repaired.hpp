// The certificate of any skeleton against a repaired surface.
#pragma once

#include <optional>

#include <curveskel/certificate.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

struct RepairedEvaluation {
  Certificate certificate;
  /// The surface of the certificate, if it is not the surface given.
  std::optional<RepairedSurface> repaired_again;
};

/// `evaluate`. If it does not hold and `as_repaired.wrap` is `needed`: components that it fails for
/// and that cross themselves have no inside to be held against, so the skeleton is held against
/// what is left of them without their small handles, or against their wraps, as `extract_repaired`
/// makes them: for each the first for which it holds; where none does, the component stays. One
/// that does not cross itself is judged as it is.
/// A piece of the skeleton belongs to the smallest component that holds most of its nodes. Throws
/// Cancelled on a stop.
[[nodiscard]] RepairedEvaluation evaluate_repaired(const RepairedSurface& repaired,
                                                   const RepairOptions& as_repaired,
                                                   const CurveSkeleton& skeleton,
                                                   const CertificateOptions& options = {},
                                                   const Monitor& monitor = {});

}  // namespace curveskel
