#include "app/compare_skeletons.hpp"

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>

namespace curveskel {

SkeletonComparison compare_skeletons(const CurveSkeleton& skeleton, const CurveSkeleton& other,
                                     const Surface& surface, const CertificateOptions& options,
                                     const Monitor& monitor) {
  const double diagonal = bounding_box_diagonal(surface.positions);
  const double spacing = options.sample_spacing * diagonal;
  SkeletonComparison found;
  found.hausdorff_distance = hausdorff_distance(skeleton, other, spacing) / diagonal;
  found.mean_distance = mean_distance(skeleton, other, spacing) / diagonal;
  found.common_ground = common_ground(SurfaceTree(surface, options.threads), diagonal, skeleton,
                                      other, options, monitor);
  return found;
}

}  // namespace curveskel
