#include "skeleton/certify/reach_at_tips.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/certify/sample_balls.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double least_heading = 1.0 / 100;  // of D

/// Infinite coordinates where there is none: from outside, or for a branch without a length.
Vector3d surface_ahead(const MeasuredCurve& curve, const std::vector<Vector3d>& to_tip) {
  const Vector3d& tip = to_tip.back();
  const double radius = curve.tree.inscribed_radius(tip);
  const double way = std::max(radius, least_heading * curve.diagonal);
  const auto before = std::find_if(to_tip.rbegin(), to_tip.rend() - 1,
                                   [&](const Vector3d& p) { return (p - tip).norm() >= way; });
  const Vector3d heading = (tip - *before).normalized();
  if (radius <= 0 || heading.isZero()) {
    return Vector3d::Constant(std::numeric_limits<double>::infinity());
  }
  return tip + curve.tree.ray(tip, heading).distance * heading;
}

std::vector<Vector3d> places_ahead(const MeasuredCurve& curve) {
  std::vector<Vector3d> places;
  for (const Branch& branch : curve.branches) {
    std::vector<Vector3d> line = polyline(curve.skeleton, branch);
    for (const int end : {branch.nodes.back(), branch.nodes.front()}) {
      if (curve.degree[idx(end)] == 1) places.push_back(surface_ahead(curve, line));
      std::reverse(line.begin(), line.end());
    }
  }
  return places;
}

}  // namespace

double reach_at_tips(const MeasuredCurve& curve) {
  const SampleBalls sample_balls{curve};
  const SequenceTree balls = sample_balls.tree(1);
  double farthest = 0;
  for (const Vector3d& place : places_ahead(curve)) {
    if (!place.allFinite()) continue;
    const auto gap_to = [&](std::size_t sample) { return sample_balls.gap(sample, place, 1); };
    farthest = std::max(farthest, balls.minimum(place, farthest, gap_to));
  }
  return farthest / curve.diagonal;
}

}  // namespace curveskel
