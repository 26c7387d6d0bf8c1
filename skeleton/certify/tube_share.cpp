#include "skeleton/certify/tube_share.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/certify/curve_pieces.hpp"
#include "surface/spatial/spread_points.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double tube_factor = 2.5;  // of the inscribed radius
constexpr int points_over_area = 2500;

/// The inscribed radius in the component that the sample's curve is of, which the skeleton knows if
/// it has radii: where components cross, the nearest face may be another's, inside.
double radius_of(const MeasuredCurve& curve, std::size_t i) {
  const double measured = std::max(0.0, curve.radius[i]);
  const CurveSkeleton& skeleton = curve.skeleton;
  const CurveSample& sample = curve.samples[i];
  if (skeleton.radii.size() != skeleton.nodes.rows() || sample.branch < 0) return measured;
  const std::vector<int>& nodes = curve.branches[idx(sample.branch)].nodes;
  const int a = nodes[idx(sample.segment)];
  const int b = nodes[idx(sample.segment) + 1];
  const double length = (skeleton.nodes.row(b) - skeleton.nodes.row(a)).norm();
  const double way = (sample.position.transpose() - skeleton.nodes.row(a)).norm();
  const double share = length > 0 ? std::min(1.0, way / length) : 0;
  return std::max(measured, (1 - share) * skeleton.radii[a] + share * skeleton.radii[b]);
}

}  // namespace

double tube_share(const MeasuredCurve& curve, const Surface& surface, const Monitor& monitor) {
  if (curve.samples.empty()) return 0;
  monitor.report("certify", 0.8);
  const CurvePieces pieces{curve.samples};
  std::vector<SequenceTree::Item> items;
  items.reserve(curve.samples.size());
  for (std::size_t i = 0; i < curve.samples.size(); ++i)
    items.push_back(pieces.item(i, pieces.reach(i), 0));
  const SequenceTree tree(items, curve.order);
  const std::vector<Vector3d> points = spread_points(surface, points_over_area);
  if (points.empty()) return 0;
  std::vector<char> near(points.size());
  parallel_for(points.size(), 256, curve.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t nearest = 0;  // of the point before, to begin with
    for (std::size_t i = begin; i < end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      const std::size_t first = nearest;
      const auto distance_to = [&](std::size_t sample) {
        const double distance = pieces.distance(sample, points[i], pieces.reach(sample));
        if (distance < least) {
          least = distance;
          nearest = sample;
        }
        return distance;
      };
      (void)tree.minimum(points[i], 0, distance_to, first);
      near[i] = least <= tube_factor * radius_of(curve, nearest) ? 1 : 0;
    }
  });
  return static_cast<double>(std::count(near.begin(), near.end(), 1)) /
         static_cast<double>(points.size());
}

double tube_share(const Surface& surface, const CurveSkeleton& skeleton,
                  const CertificateOptions& options, const Monitor& monitor) {
  const SurfaceTree tree(surface, options.threads);
  return tube_share(
      measured_curve(tree, bounding_box_diagonal(surface.positions), skeleton, options, monitor),
      surface, monitor);
}

}  // namespace curveskel
