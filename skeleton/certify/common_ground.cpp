#include <algorithm>
#include <utility>
#include <vector>

#include <curveskel/certificate.hpp>
#include "skeleton/certify/centredness.hpp"
#include "skeleton/certify/measured_curve.hpp"
#include "skeleton/graph/skeleton_segments.hpp"

namespace curveskel {
namespace {

constexpr double least_nearness = 1.0 / 100;  // of D

CommonGround::Side side_of(const MeasuredCurve& curve, const SkeletonSegments& other, int rays,
                           const Monitor& monitor) {
  const std::vector<double> variation = ray_variations(curve, rays, monitor);
  std::vector<std::pair<double, double>> weighted;
  double length = 0;
  double common = 0;
  for (std::size_t i = 0; i < variation.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    length += sample.length;
    const double near = std::max(curve.radius[i], least_nearness * curve.diagonal);
    if (other.distance(sample.position) > near) continue;
    common += sample.length;
    if (variation[i] >= 0) weighted.emplace_back(variation[i], sample.length);
  }
  return {length > 0 ? common / length : 0, weighted_quantile(std::move(weighted), 0.5)};
}

}  // namespace

CommonGround common_ground(const SurfaceTree& tree, double diagonal, const CurveSkeleton& a,
                           const CurveSkeleton& b, const CertificateOptions& options,
                           const Monitor& monitor) {
  const MeasuredCurve curve_of_a = measured_curve(tree, diagonal, a, options, monitor);
  const MeasuredCurve curve_of_b = measured_curve(tree, diagonal, b, options, monitor);
  return {side_of(curve_of_a, SkeletonSegments(b), options.rays, monitor),
          side_of(curve_of_b, SkeletonSegments(a), options.rays, monitor)};
}

}  // namespace curveskel
