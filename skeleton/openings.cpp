#include "skeleton/openings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "surface/element_index.hpp"
#include "surface/measures.hpp"

namespace curveskel {
namespace {

struct Rim {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double mean_radius = 0;
  double least_radius = std::numeric_limits<double>::infinity();
};

/// The middle of the rim's length, however its vertices are spaced.
Rim rim_of(const Positions& positions, const std::vector<std::int32_t>& opening) {
  Rim rim;
  double length = 0;
  for (std::size_t i = 0; i < opening.size(); ++i) {
    const Eigen::Vector3d a = positions.row(opening[i]);
    const Eigen::Vector3d b = positions.row(opening[(i + 1) % opening.size()]);
    rim.middle += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  if (length > 0) rim.middle /= length;
  for (const std::int32_t v : opening) {
    const double radius = (positions.row(v).transpose() - rim.middle).norm();
    rim.mean_radius += radius / double(opening.size());
    rim.least_radius = std::min(rim.least_radius, radius);
  }
  return rim;
}

bool way_is_inside(const SurfaceTree& tree, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to) {
  constexpr int samples = 8;
  for (int i = 1; i <= samples; ++i) {
    if (tree.inscribed_radius(from + (to - from) * i / samples) <= 0) return false;
  }
  return true;
}

void add_node(CurveSkeleton& skeleton, int neighbour, const Eigen::Vector3d& position,
              double radius) {
  const Eigen::Index node = skeleton.nodes.rows();
  skeleton.nodes.conservativeResize(node + 1, 3);
  skeleton.nodes.row(node) = position;
  skeleton.radii.conservativeResize(node + 1);
  skeleton.radii[node] = radius;
  const Eigen::Index edges = skeleton.edges.rows();
  // The new node has the highest number: among the edges of its neighbour its own comes last.
  Eigen::Index place = 0;
  while (place < edges && skeleton.edges(place, 0) <= neighbour) ++place;
  skeleton.edges.conservativeResize(edges + 1, 2);
  for (Eigen::Index e = edges; e > place; --e) skeleton.edges.row(e) = skeleton.edges.row(e - 1);
  skeleton.edges.row(place) << neighbour, static_cast<int>(node);
}

}  // namespace

void reach_openings(CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                    const std::vector<std::vector<std::int32_t>>& openings) {
  constexpr double nearness = 2.5;
  constexpr double least_width = 0.5;
  constexpr double depth = 1e-3;  // of D
  if (openings.empty()) return;
  const double below = depth * bounding_box_diagonal(surface.positions);
  std::vector<int> degree(at(skeleton.nodes.rows()), 0);
  for (const std::int32_t node : skeleton.edges.reshaped()) ++degree[at(node)];
  for (const auto& opening : openings) {
    const Rim rim = rim_of(surface.positions, opening);
    int tip = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t node = 0; node < degree.size(); ++node) {
      if (degree[node] != 1) continue;
      const auto row = static_cast<Eigen::Index>(node);
      const double radius = skeleton.radii[row];
      const double distance = (skeleton.nodes.row(row).transpose() - rim.middle).norm();
      if (distance > nearness * std::max(radius, rim.mean_radius) || distance >= nearest ||
          rim.mean_radius < least_width * radius) {
        continue;
      }
      tip = static_cast<int>(node);
      nearest = distance;
    }
    if (tip < 0 || nearest <= 2 * below) continue;
    const Eigen::Vector3d from = skeleton.nodes.row(tip);
    const Eigen::Vector3d end = rim.middle - below * (rim.middle - from).normalized();
    if (!way_is_inside(tree, from, end)) continue;
    add_node(skeleton, tip, end, rim.least_radius);
    degree[at(tip)] = 2;  // its new neighbour serves no second opening
  }
}

}  // namespace curveskel
