#include "skeleton/certify/centredness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace curveskel {
namespace {

using Eigen::Vector3d;

// Standard deviation over mean of the ray lengths in the plane normal to the curve. Rays that are
// no longer than a few times the distance to the surface, most of them in a tube, go together.
// `circle`: the rays' places on the unit circle.
double ray_variation(const SurfaceTree& tree, const CurveSample& sample, double radius,
                     const std::vector<std::pair<double, double>>& circle) {
  constexpr double together = 4;  // radii
  const auto rays = static_cast<double>(circle.size());
  const Vector3d u = sample.tangent.unitOrthogonal();
  const Vector3d w = sample.tangent.cross(u);
  std::vector<Vector3d> directions;
  directions.reserve(circle.size());
  for (const auto& [along_u, along_w] : circle) directions.emplace_back(along_u * u + along_w * w);
  std::vector<double> lengths(directions.size());
  tree.rays_in_plane(sample.position, sample.tangent, directions, together * radius, lengths);
  double sum = 0;
  double squares = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    double length = lengths[k];
    if (!std::isfinite(length)) length = tree.ray(sample.position, directions[k]).distance;
    if (!std::isfinite(length)) return 0;  // the surface is not closed
    sum += length;
    squares += length * length;
  }
  const double mean = sum / rays;
  return std::sqrt(std::max(0.0, squares / rays - mean * mean)) / mean;
}

// Within the ball of a junction at an end of its branch the normal plane cuts the other branches.
bool at_junction(const MeasuredCurve& subject, const CurveSample& sample) {
  if (sample.branch < 0) return false;
  const Branch& branch = subject.branches[static_cast<std::size_t>(sample.branch)];
  for (const int node : {branch.nodes.front(), branch.nodes.back()}) {
    if (!subject.is_junction(node)) continue;
    const Vector3d junction = subject.skeleton.nodes.row(node);
    if ((sample.position - junction).norm() < subject.clearance[node]) return true;
  }
  return false;
}

}  // namespace

std::vector<double> ray_variations(const MeasuredCurve& curve, int rays, const Monitor& monitor) {
  constexpr double left_out = -1;
  std::vector<std::pair<double, double>> circle;
  for (int k = 0; k < rays; ++k) {
    const double angle = 2 * std::numbers::pi * k / rays;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  std::vector<double> variation(curve.samples.size(), left_out);
  const auto measure = [&](bool at_junctions_too) {
    for_samples(curve, 0.2, 0.7, monitor, [&](std::size_t i) {
      const CurveSample& sample = curve.samples[i];
      if (curve.radius[i] <= 0) {
        variation[i] = std::numeric_limits<double>::infinity();
      } else if (at_junctions_too || !at_junction(curve, sample)) {
        variation[i] = ray_variation(curve.tree, sample, curve.radius[i], circle);
      }
    });
  };
  const auto measured = [](double value) { return std::isfinite(value) && value != left_out; };
  measure(false);
  if (std::none_of(variation.begin(), variation.end(), measured)) measure(true);
  return variation;
}

double weighted_quantile(std::vector<std::pair<double, double>> value_and_weight, double share) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  double below = 0;
  for (const auto& [value, weight] : value_and_weight) {
    below += weight;
    if (below >= share * total) return value;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace curveskel
