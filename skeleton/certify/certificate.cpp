#include <curveskel/certificate.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "base/option_ranges.hpp"
#include "base/parallel.hpp"
#include "skeleton/certify/centredness.hpp"
#include "skeleton/certify/measured_curve.hpp"
#include "skeleton/certify/own_curves.hpp"
#include "skeleton/certify/reach_at_tips.hpp"
#include "skeleton/certify/sample_balls.hpp"
#include "skeleton/certify/tube_share.hpp"
#include "skeleton/certify/verdict.hpp"
#include "skeleton/graph/sequence_tree.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/homology/homology_rank.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double curvature_scale = 1.0 / 100;  // of D
constexpr double coverage_factor = 1.5;        // of the local radius
constexpr Eigen::Index most_vertices = 20000;

void measure_inside(const MeasuredCurve& subject, const CertificateOptions& options,
                    Certificate& certificate) {
  double length = 0;
  double inside = 0;
  for (std::size_t i = 0; i < subject.samples.size(); ++i) {
    length += subject.samples[i].length;
    if (subject.radius[i] > 0) {
      inside += subject.samples[i].length;
    } else {
      certificate.deepest_exit =
          std::max(certificate.deepest_exit, -subject.radius[i] / subject.diagonal);
    }
  }
  certificate.inside_fraction = length > 0 ? inside / length : 0;
  certificate.inside_enough = certificate.inside_fraction >= options.inside_needed;
}

void measure_centredness(const MeasuredCurve& subject, int rays, const Monitor& monitor,
                         Certificate& certificate) {
  const std::vector<double> variation = ray_variations(subject, rays, monitor);
  std::vector<std::pair<double, double>> weighted;
  for (std::size_t i = 0; i < variation.size(); ++i) {
    if (variation[i] >= 0) weighted.emplace_back(variation[i], subject.samples[i].length);
  }
  certificate.centredness_median = weighted_quantile(weighted, 0.5);
  certificate.centredness_p90 = weighted_quantile(std::move(weighted), 0.9);
}

void measure_coverage(const MeasuredCurve& subject, const Positions& vertices,
                      const Monitor& monitor, Certificate& certificate) {
  if (subject.samples.empty()) {
    certificate.reach = std::numeric_limits<double>::infinity();
    return;
  }
  const SampleBalls sample_balls{subject};
  const SequenceTree balls = sample_balls.tree(1);
  const SequenceTree wide_balls = sample_balls.tree(coverage_factor);
  const Eigen::Index stride = (vertices.rows() + most_vertices - 1) / most_vertices;
  const auto chosen = static_cast<std::size_t>((vertices.rows() + stride - 1) / stride);
  std::vector<char> covered(chosen);
  std::vector<double> uncovered(chosen);
  monitor.report("certify", 0.7);
  parallel_for(chosen, 256, subject.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t nearest = 0;  // of the vertex before, to begin with
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d v = vertices.row(static_cast<Eigen::Index>(i) * stride);
      // Looking for the nearest ball mostly meets one that covers the vertex.
      bool met = false;
      double least = std::numeric_limits<double>::infinity();
      const std::size_t first = nearest;
      const auto gap_to = [&](std::size_t sample) {
        met = met || sample_balls.gap(sample, v, coverage_factor) <= 0;
        const double own = sample_balls.gap(sample, v, 1);
        if (own < least) {
          least = own;
          nearest = sample;
        }
        return own;
      };
      uncovered[i] = std::max(0.0, balls.minimum(v, 0, gap_to, first));
      met = met || wide_balls.reaches(v, [&](std::size_t sample) {
        return sample_balls.gap(sample, v, coverage_factor);
      });
      covered[i] = met ? 1 : 0;
    }
  });
  const auto number = std::count(covered.begin(), covered.end(), 1);
  certificate.coverage = static_cast<double>(number) / static_cast<double>(chosen);
  std::vector<std::pair<double, double>> distances;
  distances.reserve(uncovered.size());
  for (const double distance : uncovered) distances.emplace_back(distance, 1);
  certificate.reach = weighted_quantile(std::move(distances), 0.95) / subject.diagonal;
}

// Sum of the angles between successive chords of about `step`.
double total_curvature_of(const MeasuredCurve& subject, const Branch& branch, double step) {
  const auto line = polyline(subject.skeleton, branch);
  const double length = polyline_length(line);
  const int chords = static_cast<int>(std::lround(length / step));
  if (chords < 2) return 0;
  std::vector<double> arc_lengths;
  for (int k = 0; k <= chords; ++k) arc_lengths.push_back(length * k / chords);
  auto points = points_along(line, arc_lengths);
  const bool cycle =
      branch.nodes.front() == branch.nodes.back() && !subject.is_junction(branch.nodes.front());
  if (cycle) points.push_back(points[1]);
  double angles = 0;
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Vector3d a = points[k - 1] - points[k - 2];
    const Vector3d b = points[k] - points[k - 1];
    angles += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return angles;
}

void measure_shape(const MeasuredCurve& subject, Certificate& certificate) {
  double length = 0;
  double angles = 0;
  for (const Branch& branch : subject.branches) {
    length += polyline_length(polyline(subject.skeleton, branch));
    angles += total_curvature_of(subject, branch, curvature_scale * subject.diagonal);
  }
  certificate.length = length / subject.diagonal;
  certificate.total_curvature = length > 0 ? angles / certificate.length : 0;
  certificate.spurs = static_cast<int>(spurs_of(subject).size());
}

void count(const CurveSkeleton& skeleton, Certificate& certificate) {
  const GraphTopology graph = graph_topology(skeleton);
  certificate.components = graph.components;
  certificate.cycle_rank = graph.cycle_rank;
  certificate.tips = graph.tips;
  certificate.junctions = graph.junctions;
}

/// All that `Certificate::correct` asks.
Certificate judged(const CertifiedSurface& surface, const MeasuredCurve& subject,
                   const CertificateOptions& options) {
  const CurveSkeleton& skeleton = subject.skeleton;
  Certificate certificate;
  count(skeleton, certificate);
  certificate.components_of_surface = surface.components;
  certificate.genus = surface.genus;
  certificate.homology_rank = surface.genus > 0 ? homology_rank(surface.surface, skeleton) : 0;
  measure_inside(subject, options, certificate);
  const bool may_be_elsewhere = surface.components > 1 || certificate.inside_fraction == 0;
  if (may_be_elsewhere && certificate.components == surface.components) {
    certificate.components_without_curve = components_without_curve(surface.surface, skeleton);
  }
  return certificate;
}

}  // namespace

void require_valid(const CertificateOptions& options) {
  constexpr OptionRange spacing{1e-6, 1};
  constexpr OptionRange rays{3, 4096};
  const OptionCheck check("CertificateOptions");
  check.number("sample_spacing", options.sample_spacing, spacing);
  check.number("inside_needed", options.inside_needed, {});  // above 1: never enough
  check.number("rays", options.rays, rays);
  check.number("threads", options.threads, thread_range);
}

Certificate evaluate(const Surface& surface, const CurveSkeleton& skeleton,
                     const CertificateOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_closed_manifold(surface, "evaluate", options.threads);
  monitor.report("certify", 0);
  const Topology counted = topology(surface);
  return evaluate(
      {surface, SurfaceTree(surface, options.threads), bounding_box_diagonal(surface.positions),
       counted.components(), counted.total_genus()},
      skeleton, options, monitor);
}

Certificate evaluate(const CertifiedSurface& surface, const CurveSkeleton& skeleton,
                     const CertificateOptions& options, const Monitor& monitor) {
  require_sound(surface.surface, "evaluate");
  require_sound(skeleton, "evaluate");
  monitor.report("certify", 0);
  const MeasuredCurve subject =
      measured_curve(surface.tree, surface.diagonal, skeleton, options, monitor);
  Certificate certificate = judged(surface, subject, options);
  measure_centredness(subject, options.rays, monitor, certificate);
  measure_coverage(subject, surface.surface.positions, monitor, certificate);
  certificate.reach_at_tips = reach_at_tips(subject);
  certificate.tube_share = tube_share(subject, surface.surface, monitor);
  certificate.curve_like = certificate.tube_share >= tube_share_needed;
  measure_shape(subject, certificate);
  monitor.report("certify", 1);
  return certificate;
}

Certificate verdict(const CertifiedSurface& surface, const CurveSkeleton& skeleton,
                    const CertificateOptions& options, const Monitor& monitor) {
  monitor.report("certify", 0);
  return judged(surface, measured_curve(surface.tree, surface.diagonal, skeleton, options, monitor),
                options);
}

}  // namespace curveskel
