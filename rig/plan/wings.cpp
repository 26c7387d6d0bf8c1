#include "rig/plan/wings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "rig/plan/trunk.hpp"
#include "rig/plan/tubes.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// By node.
std::vector<char> nodes_of_wings(const CurveTree& tree, const Limbs& limbs, int wings) {
  std::vector<char> is_wing(tree.nodes.size(), 0);
  const LimbWay& way = limbs.pairs[idx(wings)].ways.front();
  for (const int tip : {way.path.back(), way.mirror.back()}) {
    std::vector<char> seen = limbs.is_trunk;
    if (seen[idx(tip)] != 0) continue;
    for (const int node : part_of(tree, tip, seen)) is_wing[idx(node)] = 1;
  }
  return is_wing;
}

/// The surface of a bird, in its wings and all the rest.
struct Feathered {
  std::vector<PointOfNode> wings;
  std::vector<PointOfNode> rest;
};

Feathered feathered(const CurveTree& tree, const Limbs& limbs, int wings) {
  const std::vector<char> is_wing = nodes_of_wings(tree, limbs, wings);
  Feathered bird;
  for (const PointOfNode& at : points_by_nodes(tree)) {
    (is_wing[idx(at.node)] != 0 ? bird.wings : bird.rest).push_back(at);
  }
  return bird;
}

double far_aside(const CurveTree& tree, const LimbPair& pair) {
  return std::abs(tree.aside(pair.ways.front().path.back()));
}

int widest_pair(const CurveTree& tree, const Limbs& limbs) {
  const auto widest = std::max_element(limbs.pairs.begin(), limbs.pairs.end(),
                                       [&](const LimbPair& a, const LimbPair& b) {
                                         return far_aside(tree, a) < far_aside(tree, b);
                                       });
  return static_cast<int>(widest - limbs.pairs.begin());
}

/// From the tail's tip to the nose. Feet may be as near to the mirror plane, but are no trunk.
std::vector<int> trunk_along(const CurveTree& tree, const Limbs& limbs) {
  const auto [tail, nose] = std::minmax_element(
      limbs.trunk.begin(), limbs.trunk.end(),
      [&](int a, int b) { return tree.nodes[idx(a)].z() < tree.nodes[idx(b)].z(); });
  return ways_from(tree, *tail).path(*nose);
}

bool is_level(const CurveTree& tree, const std::vector<int>& trunk) {
  constexpr double shortest = 0.25;  // of the size, which is the span: an albatross has .35
  const Along line = along(tree, trunk);
  const Vector3d reach = line.points.back() - line.points.front();
  return reach.z() > shortest * tree.size && std::abs(reach.y()) < 0.5 * reach.z() &&
         line.whole() < 1.2 * reach.z();
}

int thickest_of(const CurveTree& tree, const std::vector<int>& trunk) {
  return *std::max_element(trunk.begin(), trunk.end(),
                           [&](int a, int b) { return tree.radii[idx(a)] < tree.radii[idx(b)]; });
}

/// Along the trunk: of a round wing most of the surface is within a radius of the curve, and so is
/// that of an upright blade.
bool are_flat(const CurveTree& tree, const LimbPair& pair, const Feathered& bird, double thick) {
  constexpr double flat = 2;
  const Course course = mean_course(tree, pair.ways.front());
  const auto half = std::ptrdiff_t(course.radii.size() / 2);
  const double thin = median_of({course.radii.begin() + half, course.radii.end()});
  std::vector<double> off;  // in the outer halves
  for (const PointOfNode& at : bird.wings) {
    if (std::abs(at.point.x() - tree.middle) > 0.5 * far_aside(tree, pair)) {
      off.push_back(std::abs(tree.nodes[idx(at.node)].z() - at.point.z()));
    }
  }
  return !off.empty() && median_of(std::move(off)) > flat * thin && thick > flat * thin;
}

Eigen::AlignedBox1d length_of(const std::vector<PointOfNode>& points) {
  Eigen::AlignedBox1d length;
  for (const PointOfNode& at : points) length.extend(at.point.segment<1>(2));
  return length;
}

/// -1 in the rearmost share of the length, 1 in the foremost, 0 between.
int end_at(const Eigen::AlignedBox1d& length, double z, double share) {
  const double way = (z - length.min()[0]) / length.sizes()[0];
  return way < share ? -1 : way > 1 - share ? 1 : 0;
}

/// An aeroplane's stands at its rear, three radii of the trunk high and more. A bird's tail is
/// level, and a neck that it lifts is round.
bool has_upright_fin(const CurveTree& tree, int thickest, const Feathered& bird) {
  constexpr double high = 2;  // radii
  constexpr double share = 0.25;
  const double above = tree.nodes[idx(thickest)].y() + high * tree.radii[idx(thickest)];
  const Eigen::AlignedBox1d length = length_of(bird.rest);
  int flat = 0;
  int round = 0;
  for (const PointOfNode& at : bird.rest) {
    if (at.point.y() < above || end_at(length, at.point.z(), share) == 0) continue;
    ++(is_near_curve(tree, at) ? round : flat);
  }
  return flat > round;
}

/// The end that is clearly flatter than the other: -1 the rear, 1 the front, 0 none.
int flat_end(const CurveTree& tree, const Limbs& limbs, int wings) {
  constexpr double share = 0.2;
  constexpr double clearly = 1.5;
  const Feathered bird = feathered(tree, limbs, wings);
  const Eigen::AlignedBox1d length = length_of(bird.rest);
  double width[2] = {0, 0};
  double height[2] = {0, 0};
  for (const PointOfNode& at : bird.rest) {
    const int end = end_at(length, at.point.z(), share);
    if (end == 0) continue;
    width[end < 0 ? 0 : 1] += std::abs(at.point.x() - tree.middle);
    height[end < 0 ? 0 : 1] += std::abs(at.point.y() - tree.nodes[idx(at.node)].y());
  }
  if (width[0] * height[1] > clearly * width[1] * height[0]) return -1;
  return width[1] * height[0] > clearly * width[0] * height[1] ? 1 : 0;
}

}  // namespace

int flat_wings(const CurveTree& tree, const Limbs& limbs) {
  constexpr double least_span = 0.8;  // of the size; a fish is narrower
  if (limbs.pairs.empty() || tree.cycles > 0) return -1;
  const int wings = widest_pair(tree, limbs);
  const LimbPair& pair = limbs.pairs[idx(wings)];
  if (2 * far_aside(tree, pair) < least_span * tree.size) return -1;
  const std::vector<int> trunk = trunk_along(tree, limbs);
  if (!is_level(tree, trunk)) return -1;
  const int thickest = thickest_of(tree, trunk);
  const Feathered bird = feathered(tree, limbs, wings);
  if (bird.rest.empty() || !are_flat(tree, pair, bird, tree.radii[idx(thickest)])) return -1;
  return has_upright_fin(tree, thickest, bird) ? -1 : wings;
}

double tubes_but_for_wings(const CurveTree& tree, const Limbs& limbs, int wings) {
  const std::vector<char> is_wing = nodes_of_wings(tree, limbs, wings);
  return tubes_among(tree, [&](int node) { return is_wing[idx(node)] == 0; });
}

bool has_a_flat_end(const CurveTree& tree, const Limbs& limbs, int wings) {
  return flat_end(tree, limbs, wings) != 0;
}

bool flies_back(const CurveTree& tree, const Limbs& limbs, int wings) {
  const int end = flat_end(tree, limbs, wings);
  const LimbPair& pair = limbs.pairs[idx(wings)];
  const Course course = mean_course(tree, pair.ways.front());
  const bool is_swept_ahead = course.points.back().z() > course.points.front().z();
  return end > 0 || (end == 0 && is_swept_ahead);
}

}  // namespace curveskel
