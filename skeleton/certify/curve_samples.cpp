#include "skeleton/certify/curve_samples.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <curveskel/error.hpp>

namespace curveskel {

using Eigen::Vector3d;

std::vector<Vector3d> polyline(const CurveSkeleton& skeleton, const Branch& branch) {
  std::vector<Vector3d> line;
  line.reserve(branch.nodes.size());
  for (const int node : branch.nodes) line.emplace_back(skeleton.nodes.row(node));
  return line;
}

double polyline_length(const std::vector<Vector3d>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

std::vector<Vector3d> points_along(const std::vector<Vector3d>& line,
                                   const std::vector<double>& arc_lengths,
                                   std::vector<int>* segments) {
  std::vector<Vector3d> points;
  points.reserve(arc_lengths.size());
  std::size_t edge = 0;  // from line[edge] to line[edge + 1]
  double passed = 0;     // length of the edges before it
  for (const double target : arc_lengths) {
    while (edge + 2 < line.size()) {
      const double step = (line[edge + 1] - line[edge]).norm();
      if (passed + step >= target) break;
      passed += step;
      ++edge;
    }
    const Vector3d along = line[edge + 1] - line[edge];
    const double step = along.norm();
    const double t = step > 0 ? std::clamp((target - passed) / step, 0.0, 1.0) : 0;
    points.emplace_back(line[edge] + t * along);
    if (segments != nullptr) segments->push_back(static_cast<int>(edge));
  }
  return points;
}

namespace {

void require_few_samples(const CurveSkeleton& skeleton, const std::vector<Branch>& branches,
                         double spacing) {
  constexpr double most = 1e7;  // a gigabyte
  double length = 0;
  for (const Branch& branch : branches) length += polyline_length(polyline(skeleton, branch));
  if (length <= most * spacing) return;
  std::ostringstream message;
  message << "the skeleton is " << length / spacing << " times as long as the spacing of its "
          << "samples, needed at most " << most << "; give a skeleton in the coordinates of the "
          << "surface, or samples farther apart";
  throw Error(Fault::input, message.str());
}

}  // namespace

std::vector<CurveSample> sample_branches(const CurveSkeleton& skeleton,
                                         const std::vector<Branch>& branches, double spacing,
                                         double tangent_length) {
  require_few_samples(skeleton, branches, spacing);
  std::vector<CurveSample> samples;
  std::vector<double> middles;
  std::vector<double> starts;
  std::vector<double> ends;
  std::vector<int> segments;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const auto line = polyline(skeleton, branches[b]);
    const double length = polyline_length(line);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    middles.clear();
    starts.clear();
    ends.clear();
    segments.clear();
    for (int k = 0; k < pieces; ++k) {
      const double middle = (k + 0.5) * length / pieces;
      middles.push_back(middle);
      starts.push_back(std::max(0.0, middle - tangent_length / 2));
      ends.push_back(std::min(length, middle + tangent_length / 2));
    }
    const auto positions = points_along(line, middles, &segments);
    const auto from = points_along(line, starts);
    const auto to = points_along(line, ends);
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Vector3d chord = to[k] - from[k];
      const double norm = chord.norm();
      samples.push_back({positions[k], norm > 0 ? Vector3d(chord / norm) : Vector3d::UnitZ(),
                         length / pieces, static_cast<int>(b), segments[k]});
    }
  }
  return samples;
}

}  // namespace curveskel
