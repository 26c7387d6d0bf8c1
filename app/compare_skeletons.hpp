// Two skeletons of one surface beside each other, as `evaluate --against` has them.
#pragma once

#include <string>

#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct SkeletonComparison {
  std::string against;            ///< the other skeleton's file, empty = none
  double hausdorff_distance = 0;  ///< of the surface's D
  double mean_distance = 0;       ///< the same in the mean
  CommonGround common_ground;     ///< a is the one, b the other
};

/// `against` stays empty. Precondition: closed, oriented surface. Throws Cancelled on a stop.
[[nodiscard]] SkeletonComparison compare_skeletons(const CurveSkeleton& skeleton,
                                                   const CurveSkeleton& other,
                                                   const Surface& surface,
                                                   const CertificateOptions& options,
                                                   const Monitor& monitor);

}  // namespace curveskel
