#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/error.hpp>
#include "skeleton/certify/curve_samples.hpp"
#include "skeleton/graph/skeleton_segments.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

double farthest(const CurveSkeleton& from, const SkeletonSegments& to, double spacing) {
  double largest = 0;
  for (Eigen::Index node = 0; node < from.nodes.rows(); ++node) {
    largest = std::max(largest, to.distance(from.nodes.row(node)));
  }
  for (const CurveSample& sample : sample_branches(from, branches(from), spacing, spacing)) {
    largest = std::max(largest, to.distance(sample.position));
  }
  return largest;
}

double mean(const CurveSkeleton& from, const SkeletonSegments& to, double spacing) {
  double sum = 0;
  double length = 0;
  for (const CurveSample& sample : sample_branches(from, branches(from), spacing, spacing)) {
    sum += sample.length * to.distance(sample.position);
    length += sample.length;
  }
  return length > 0 ? sum / length : farthest(from, to, spacing);
}

void require_measurable(const CurveSkeleton& a, const CurveSkeleton& b, double spacing,
                        std::string_view purpose) {
  require_sound_places(a, purpose);
  require_sound_places(b, purpose);
  if (spacing > 0 && std::isfinite(spacing)) return;
  throw Error(Fault::usage, std::string(purpose) + ": found the spacing " +
                                std::to_string(spacing) + ", needed one above 0 and finite");
}

}  // namespace

double mean_distance(const CurveSkeleton& a, const CurveSkeleton& b, double spacing) {
  require_measurable(a, b, spacing, "mean_distance");
  return (mean(a, SkeletonSegments(b), spacing) + mean(b, SkeletonSegments(a), spacing)) / 2;
}

double hausdorff_distance(const CurveSkeleton& a, const CurveSkeleton& b, double spacing) {
  require_measurable(a, b, spacing, "hausdorff_distance");
  const SkeletonSegments segments_of_a(a);
  const SkeletonSegments segments_of_b(b);
  return std::max(farthest(a, segments_of_b, spacing), farthest(b, segments_of_a, spacing));
}

}  // namespace curveskel
