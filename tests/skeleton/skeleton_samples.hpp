// Skeletons that exercise every corner of the file formats: what a writer is tested with.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

struct SkeletonSample {
  std::string name;
  CurveSkeleton skeleton;
};

inline CurveSkeleton make_skeleton(const std::vector<Eigen::RowVector3d>& nodes,
                                   const std::set<std::pair<int, int>>& edges, bool radii = true) {
  CurveSkeleton skeleton;
  const auto count = static_cast<Eigen::Index>(nodes.size());
  skeleton.nodes.resize(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    skeleton.nodes.row(n) = nodes[static_cast<std::size_t>(n)];
  }
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [i, j] : edges) skeleton.edges.row(row++) << i, j;
  if (radii) skeleton.radii = Eigen::VectorXd::LinSpaced(count, 0.1, 1.0 / 3);
  skeleton.node_of_vertex = Eigen::VectorXi::LinSpaced(3 * count, 0, static_cast<int>(count) - 1);
  return skeleton;
}

inline std::vector<Eigen::RowVector3d> points_on_circle(int count, double x) {
  std::vector<Eigen::RowVector3d> points;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * k / count;
    points.emplace_back(x + std::cos(angle), std::sin(angle), 0.1 * k);
  }
  return points;
}

/// Positions and radii with all 53 bits in use, over many magnitudes.
inline SkeletonSample random_sample(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const int count = 5 + static_cast<int>(random() % 30);
  std::vector<Eigen::RowVector3d> nodes;
  nodes.reserve(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    nodes.emplace_back(unit(random), unit(random) * std::pow(10, 12 * unit(random)), unit(random));
  }
  std::set<std::pair<int, int>> edges;
  for (int e = 0; e < count; ++e) {
    const int a = static_cast<int>(random() % static_cast<unsigned>(count));
    const int b = static_cast<int>(random() % static_cast<unsigned>(count));
    if (a != b) edges.insert(std::minmax({a, b}));
  }
  SkeletonSample sample{"random_" + std::to_string(seed), make_skeleton(nodes, edges)};
  for (double& radius : sample.skeleton.radii) radius = std::abs(unit(random)) + 1e-12;
  return sample;
}

inline std::vector<SkeletonSample> skeleton_samples() {
  std::vector<SkeletonSample> samples;
  const Eigen::RowVector3d origin(0, 0, 0);
  samples.push_back({"point", make_skeleton({{0.1, -2, 3e-7}}, {})});
  samples.push_back({"segment", make_skeleton({origin, {1.0 / 3, 2.0 / 7, -1e-17}}, {{0, 1}})});
  samples.push_back({"tripod", make_skeleton({origin, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0.1}},
                                             {{0, 1}, {0, 2}, {0, 3}, {1, 4}})});
  samples.push_back(
      {"circle", make_skeleton(points_on_circle(7, 0),
                               {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {0, 6}})});
  samples.push_back(
      {"theta", make_skeleton({origin, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}},
                              {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {0, 4}, {1, 4}})});
  std::vector<Eigen::RowVector3d> pieces = points_on_circle(4, 10);
  pieces.insert(pieces.end(), {origin, {1, 1, 1}, {-5, 0, 1e6}});
  samples.push_back(
      {"loop_segment_point", make_skeleton(pieces, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}})});
  samples.push_back(
      {"without_radii", make_skeleton({origin, {1, 2, 3}, {4, 5, 6.5}}, {{0, 1}, {1, 2}}, false)});
  samples.push_back(
      {"node_outside", make_skeleton({origin, {1, 2, 3}, {4, 5, 6.5}}, {{0, 1}, {1, 2}})});
  samples.back().skeleton.radii(1) = 0;
  for (unsigned seed = 0; seed < 4; ++seed) samples.push_back(random_sample(seed));
  return samples;
}

}  // namespace curveskel
