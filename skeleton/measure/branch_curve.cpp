#include "skeleton/measure/branch_curve.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// A place between two points of the polyline.
struct Between {
  Eigen::Index before;
  double share;  ///< of the way to the next
};

Between locate(const BranchCurve& curve, double s) {
  const double length = curve.length();
  if (curve.closed && length > 0) s -= std::floor(s / length) * length;
  const auto next = std::upper_bound(curve.lengths.begin() + 1, curve.lengths.end() - 1, s);
  const auto before = next - curve.lengths.begin() - 1;
  const double from = curve.lengths[idx(before)];
  const double step = *next - from;
  return {before, step > 0 ? std::clamp((s - from) / step, 0.0, 1.0) : 0.0};
}

/// Nodes that a cubic is laid through, with their lengths: one past either end of a closed curve
/// has a number past that of its first or last.
struct Stretch {
  std::ptrdiff_t first;
  std::ptrdiff_t last;
};

/// The length of a node of `Stretch`.
double length_of(const BranchCurve& curve, std::ptrdiff_t node) {
  if (!curve.closed) return curve.lengths[idx(node)];
  const auto count = static_cast<std::ptrdiff_t>(curve.lengths.size()) - 1;
  const std::ptrdiff_t rounds = node >= 0 ? node / count : -((count - 1 - node) / count);
  return curve.lengths[idx(node - rounds * count)] + static_cast<double>(rounds) * curve.length();
}

Eigen::RowVector3d place_of(const BranchCurve& curve, std::ptrdiff_t node) {
  const auto count = static_cast<std::ptrdiff_t>(curve.lengths.size()) - 1;
  return curve.points.row(curve.closed ? (node % count + count) % count : node);
}

/// All within two radii or `least_half`, and three on either side at least, whatever the radius, as
/// far as there are: the polyline has no other knowledge of bends.
Stretch stretch_around(const BranchCurve& curve, double s, double least_half) {
  const auto count = static_cast<std::ptrdiff_t>(curve.lengths.size());
  const double radius = radius_at(curve, s);
  const double wanted = std::max(std::isnan(radius) ? 0 : 2 * radius, least_half);
  const double half = std::min(wanted, curve.length() / 2);
  const std::ptrdiff_t before = locate(curve, s).before;
  constexpr std::ptrdiff_t least = 3;
  Stretch stretch{before, before + 1};
  const auto lies_in = [&](std::ptrdiff_t node) {
    const bool exists =
        curve.closed ? stretch.last - stretch.first < count - 2 : node >= 0 && node < count;
    return exists &&
           (std::abs(length_of(curve, node) - s) <= half || std::abs(node - before) < least);
  };
  while (lies_in(stretch.first - 1)) --stretch.first;
  while (lies_in(stretch.last + 1)) ++stretch.last;
  return stretch;
}

/// The length after which the curve's own inscribed ball has left that of its end; 0 where it does
/// not, and without radii.
double clear_length(const BranchCurve& curve, bool at_start) {
  const Eigen::Index last = curve.points.rows() - 1;
  const Eigen::Index end = at_start ? 0 : last;
  for (Eigen::Index k = 1; k <= last && curve.radii.size() > 0; ++k) {
    const Eigen::Index at = at_start ? k : last - k;
    const double apart = (curve.points.row(at) - curve.points.row(end)).norm();
    if (apart <= curve.radii[end] + curve.radii[at]) continue;
    return std::abs(curve.lengths[idx(at)] - curve.lengths[idx(end)]);
  }
  return 0;
}

}  // namespace

BranchCurve branch_curve(const CurveSkeleton& skeleton, const Branch& branch) {
  BranchCurve curve;
  const auto count = static_cast<Eigen::Index>(branch.nodes.size());
  curve.points.resize(count, 3);
  if (skeleton.radii.size() > 0) curve.radii.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int node = branch.nodes[idx(k)];
    curve.points.row(k) = skeleton.nodes.row(node);
    if (skeleton.radii.size() > 0) curve.radii[k] = skeleton.radii[node];
    const double step = k == 0 ? 0 : (curve.points.row(k) - curve.points.row(k - 1)).norm();
    curve.lengths.push_back(k == 0 ? 0 : curve.lengths.back() + step);
  }
  curve.closed = branch.nodes.front() == branch.nodes.back();
  return curve;
}

Eigen::Vector3d point_at(const BranchCurve& curve, double s) {
  const auto [before, share] = locate(curve, s);
  return (1 - share) * curve.points.row(before) + share * curve.points.row(before + 1);
}

double radius_at(const BranchCurve& curve, double s) {
  if (curve.radii.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto [before, share] = locate(curve, s);
  return (1 - share) * curve.radii[before] + share * curve.radii[before + 1];
}

CurveDerivatives derivatives_at(const BranchCurve& curve, double s, double least_half) {
  if (curve.closed && curve.length() > 0) s -= std::floor(s / curve.length()) * curve.length();
  const Stretch stretch = stretch_around(curve, s, least_half);
  // Of a dense polyline some nodes say as much as all.
  constexpr std::ptrdiff_t most = 32;
  const std::ptrdiff_t step = std::max<std::ptrdiff_t>(1, (stretch.last - stretch.first) / most);
  const Eigen::Index count = (stretch.last - stretch.first) / step + 1;
  const double unit = length_of(curve, stretch.last) - length_of(curve, stretch.first);
  CurveDerivatives still{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  if (!(unit > 0)) return still;
  Eigen::MatrixX4d powers(count, 4);
  Eigen::MatrixX3d places(count, 3);
  const Eigen::RowVector3d origin = point_at(curve, s).transpose();
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::ptrdiff_t node = stretch.first + k * step;
    // Dense nodes weigh no more than sparse ones.
    const double from = length_of(curve, std::max(node - step, stretch.first));
    const double to = length_of(curve, std::min(node + step, stretch.last));
    const double weight = std::sqrt((to - from) / unit);
    const double t = (length_of(curve, node) - s) / unit;
    powers.row(k) << weight, weight * t, weight * t * t, weight * t * t * t;
    places.row(k) = weight * (place_of(curve, node) - origin);
  }
  const Eigen::Index terms = std::min<Eigen::Index>(4, count);
  Eigen::Matrix<double, 4, 3> cubic = Eigen::Matrix<double, 4, 3>::Zero();
  cubic.topRows(terms) = powers.leftCols(terms).colPivHouseholderQr().solve(places);
  return {cubic.row(1) / unit, 2 * cubic.row(2) / (unit * unit),
          6 * cubic.row(3) / (unit * unit * unit)};
}

Eigen::Vector3d departure(const BranchCurve& curve, bool at_start) {
  const double length = curve.length();
  const std::size_t last = curve.lengths.size() - 1;
  const double clear = clear_length(curve, at_start);
  // A branch that does not leave the ball has its whole course as its direction.
  double from = 0;
  double to = length;
  if (clear > 0) {
    to = std::min(3 * clear, length);
    from = std::min(1.5 * clear, to / 2);
  } else if (curve.closed || curve.radii.size() == 0) {
    to = at_start ? curve.lengths[1] : length - curve.lengths[last - 1];
  }
  const Eigen::Vector3d a = point_at(curve, at_start ? from : length - from);
  const Eigen::Vector3d b = point_at(curve, at_start ? to : length - to);
  return (b - a).normalized();
}

}  // namespace curveskel
