#include "skeleton/certify/measured_curve.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/error.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

constexpr double tangent_scale = 1.0 / 100;  // of D

void add_samples(MeasuredCurve& curve, double spacing) {
  curve.samples =
      sample_branches(curve.skeleton, curve.branches, spacing, tangent_scale * curve.diagonal);
  for (int node = 0; node < curve.skeleton.nodes.rows(); ++node) {
    if (curve.degree[idx(node)] > 0) continue;
    curve.lone_nodes.push_back(node);
    curve.samples.push_back(
        {curve.skeleton.nodes.row(node), Eigen::Vector3d::UnitZ(), spacing, -1});
  }
}

/// One branch after the other, these along the Morton curve: those of a thousand leaves follow each
/// other in the order of the file, from one end of the tree to the other.
std::vector<std::int32_t> along_pieces(const std::vector<CurveSample>& samples) {
  std::vector<std::int32_t> firsts;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i].branch < 0 || samples[i].branch != samples[i - 1].branch) {
      firsts.push_back(static_cast<std::int32_t>(i));
    }
  }
  Positions places(static_cast<Eigen::Index>(firsts.size()), 3);
  for (std::size_t k = 0; k < firsts.size(); ++k) {
    places.row(static_cast<Eigen::Index>(k)) = samples[idx(firsts[k])].position;
  }
  firsts.push_back(static_cast<std::int32_t>(samples.size()));
  std::vector<std::int32_t> order;
  order.reserve(samples.size());
  for (const std::int32_t piece : along_morton_curve(places, 1)) {
    for (std::int32_t i = firsts[idx(piece)]; i < firsts[idx(piece) + 1]; ++i) order.push_back(i);
  }
  return order;
}

}  // namespace

MeasuredCurve measured_curve(const SurfaceTree& tree, double diagonal,
                             const CurveSkeleton& skeleton, const CertificateOptions& options,
                             const Monitor& monitor) {
  require_valid(options);
  require_sound(skeleton, "the certificate");
  if (!skeleton.nodes.allFinite()) {
    throw Error(Fault::input,
                "the skeleton has a coordinate that is no finite number; the certificate "
                "needs finite ones: repair or write the skeleton again");
  }
  if (!(diagonal > 0) || !std::isfinite(diagonal)) {
    throw Error(Fault::input,
                "the certificate found the diagonal " + std::to_string(diagonal) +
                    ", needed that of the surface's bounding box, above 0 and finite");
  }
  MeasuredCurve curve{tree, skeleton, branches(skeleton), {}, {}, {}, {}, {}, {}};
  curve.diagonal = diagonal;
  curve.threads = options.threads;
  curve.degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  curve.clearance.setZero(skeleton.nodes.rows());
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    if (!curve.is_junction(node)) continue;
    curve.clearance[node] = tree.inscribed_radius(skeleton.nodes.row(node));
  }
  add_samples(curve, options.sample_spacing * diagonal);
  curve.order = along_pieces(curve.samples);
  curve.radius.resize(curve.samples.size());
  for_sample_ranges(curve, 0.1, 0.2, monitor, [&](std::size_t begin, std::size_t end) {
    SurfaceTree::Ball before;  // mostly it holds the next sample
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& here = curve.samples[i].position;
      curve.radius[i] = tree.inscribed_radius(here, before);
      before = {here, std::max(0.0, curve.radius[i])};
    }
  });
  return curve;
}

std::vector<int> spurs_of(const MeasuredCurve& curve) {
  std::vector<int> spurs;
  for (std::size_t b = 0; b < curve.branches.size(); ++b) {
    const Branch& branch = curve.branches[b];
    int tip = branch.nodes.front();
    int junction = branch.nodes.back();
    if (curve.is_junction(tip)) std::swap(tip, junction);
    if (curve.degree[idx(tip)] != 1 || !curve.is_junction(junction)) continue;
    const double length = polyline_length(polyline(curve.skeleton, branch));
    if (length < curve.clearance[junction]) spurs.push_back(static_cast<int>(b));
  }
  return spurs;
}

}  // namespace curveskel
