#include "skeleton/pipeline/wrap_losses.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdio>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/certify/measured_curve.hpp"
#include "skeleton/graph/skeleton_segments.hpp"

namespace curveskel {
namespace {

double share_inside(const SurfaceTree& tree, double diagonal, const CurveSkeleton& skeleton,
                    const CertificateOptions& options, const Monitor& monitor) {
  const MeasuredCurve curve = measured_curve(tree, diagonal, skeleton, options, monitor);
  double length = 0;
  double inside = 0;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    length += curve.samples[i].length;
    if (curve.radius[i] > 0) inside += curve.samples[i].length;
  }
  return length > 0 ? inside / length : 0;
}

/// The share of the area that lies much farther from one curve than from the other.
double share_left(const Surface& surface, const CurveSkeleton& own, const CurveSkeleton& other,
                  double much) {
  const SkeletonSegments near(own);
  const SkeletonSegments far(other);
  double whole = 0;
  double left = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.positions.row(t(0));
    const Eigen::Vector3d b = surface.positions.row(t(1));
    const Eigen::Vector3d c = surface.positions.row(t(2));
    const double weight = (b - a).cross(c - a).norm();
    const Eigen::Vector3d middle = (a + b + c) / 3;
    whole += weight;
    if (far.distance(middle) > near.distance(middle) + much) left += weight;
  }
  return whole > 0 ? left / whole : 0;
}

}  // namespace

std::string losses_by_wrap(const FailingComponent& failing, const CurveSkeleton& from_wrap,
                           const CertificateOptions& options, const Monitor& monitor) {
  constexpr double more_outside = 0.05;  // of the length
  constexpr double much = 0.05;          // of the component's extent: a limb, no spike of noise
  constexpr double limb = 0.005;         // of the area
  const double diagonal = bounding_box_diagonal(failing.surface.positions);
  const SurfaceTree tree(failing.surface);
  const double own = share_inside(tree, diagonal, failing.skeleton, options, monitor);
  const double its = share_inside(tree, diagonal, from_wrap, options, monitor);
  const double left = share_left(failing.surface, failing.skeleton, from_wrap, much * diagonal);
  std::array<char, 200> text{};
  if (its < own - more_outside) {
    std::snprintf(text.data(), text.size(),
                  "the wrap joins what is apart: %.1f %% of its curve lie inside the surface "
                  "given, %.1f %% of the surface's own",
                  100 * its, 100 * own);
  } else if (left > limb) {
    std::snprintf(text.data(), text.size(),
                  "the wrap's curve leaves limbs out: %.1f %% of the area given is far from it",
                  100 * left);
  }
  return text.data();
}

}  // namespace curveskel
