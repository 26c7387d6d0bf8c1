#include "skeleton/certify/tube_share.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "skeleton/graph/sequence_tree.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double tube_factor = 2.5;  // of the inscribed radius
constexpr int points_over_area = 2500;

/// Points in equal steps of area, triangle after triangle; within a triangle by a sequence that
/// fills the square evenly (steps of the plastic number), folded at the diagonal.
std::vector<Vector3d> spread_points(const Surface& surface) {
  const Eigen::Index triangles = surface.triangles.rows();
  const auto corner = [&](Eigen::Index t, int k) -> Vector3d {
    return surface.positions.row(surface.triangles(t, k));
  };
  std::vector<double> area_up_to;
  area_up_to.reserve(static_cast<std::size_t>(triangles));
  double area = 0;
  for (Eigen::Index t = 0; t < triangles; ++t) {
    const Vector3d a = corner(t, 0);
    area += 0.5 * (corner(t, 1) - a).cross(corner(t, 2) - a).norm();
    area_up_to.push_back(area);
  }
  std::vector<Vector3d> points;
  if (!(area > 0)) return points;
  points.reserve(points_over_area);
  Eigen::Index t = 0;
  for (int i = 0; i < points_over_area; ++i) {
    const double wanted = area * (i + 0.5) / points_over_area;
    while (t + 1 < triangles && area_up_to[static_cast<std::size_t>(t)] < wanted) ++t;
    double whole = 0;
    double u = std::modf(0.5 + i * 0.7548776662466927, &whole);
    double v = std::modf(0.5 + i * 0.5698402909980532, &whole);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector3d a = corner(t, 0);
    points.emplace_back(a + u * (corner(t, 1) - a) + v * (corner(t, 2) - a));
  }
  return points;
}

/// The pieces of the curve that the samples stand for, which are straight but for bends within a
/// step: a hair may be thinner than the steps are long.
struct Pieces {
  const std::vector<CurveSample>& samples;

  [[nodiscard]] double reach(std::size_t i) const {
    return samples[i].branch < 0 ? 0 : 0.5 * samples[i].length;  // a lone node is no line
  }
  [[nodiscard]] Vector3d half(std::size_t i) const { return samples[i].tangent * reach(i); }
  [[nodiscard]] double distance(std::size_t i, const Vector3d& p) const {
    const CurveSample& sample = samples[i];
    const Vector3d offset = p - sample.position;
    const double along = std::clamp(offset.dot(sample.tangent), -reach(i), reach(i));
    return (offset - along * sample.tangent).norm();
  }
};

}  // namespace

double tube_share(const MeasuredCurve& curve, const Surface& surface, const Monitor& monitor) {
  if (curve.samples.empty()) return 0;
  monitor.report("certify", 0.8);
  const Pieces pieces{curve.samples};
  std::vector<SequenceTree::Item> items;
  items.reserve(curve.samples.size());
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const Vector3d& p = curve.samples[i].position;
    const Vector3d half = pieces.half(i).cwiseAbs();
    items.push_back({p - half, p + half, 0});
  }
  const SequenceTree tree(std::move(items));
  const std::vector<Vector3d> points = spread_points(surface);
  if (points.empty()) return 0;
  std::vector<char> near(points.size());
  parallel_for(points.size(), 256, curve.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t nearest = 0;  // of the point before, to begin with
    for (std::size_t i = begin; i < end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      const std::size_t first = nearest;
      const auto distance_to = [&](std::size_t sample) {
        const double distance = pieces.distance(sample, points[i]);
        if (distance < least) {
          least = distance;
          nearest = sample;
        }
        return distance;
      };
      (void)tree.minimum(points[i], 0, distance_to, first);
      near[i] = least <= tube_factor * std::max(0.0, curve.radius[nearest]) ? 1 : 0;
    }
  });
  return static_cast<double>(std::count(near.begin(), near.end(), 1)) /
         static_cast<double>(points.size());
}

}  // namespace curveskel
