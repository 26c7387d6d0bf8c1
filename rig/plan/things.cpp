#include "rig/plan/things.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/topology.hpp>
#include "rig/plan/outlook.hpp"
#include "rig/plan/tubes.hpp"
#include "rig/plan/wings.hpp"
#include "surface/mesh/component_areas.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// Of the area that is no sheet's, if there is any: leaves are put together, too.
double share_of_largest_component(const Surface& surface, const std::vector<std::int32_t>& sheets) {
  const Topology counted = topology(surface);
  const std::vector<double> with_sheets = component_areas(surface, counted);
  std::vector<double> areas = with_sheets;
  for (const std::int32_t v : sheets) areas[idx(counted.component_of_vertex[v])] = 0;
  if (!(*std::max_element(areas.begin(), areas.end()) > 0)) areas = with_sheets;
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  return all > 0 ? *std::max_element(areas.begin(), areas.end()) / all : 1;
}

/// A table has four legs, too, but is put together; dolls and robots are, as well, so this says
/// nothing about humans, and wings and fans of tails may have more area than all the rest.
bool is_put_together(const Outlook& outlook, const Surface& surface, const PlanOptions& options) {
  constexpr double most_of_it = 0.5;
  return !outlook.found.spreads_wings &&
         share_of_largest_component(surface, options.sheets) < most_of_it;
}

/// Of a bird that spreads its wings the curve may be a cross, but a tail is flat and a head is not.
bool has_a_head(const Outlook& outlook) {
  return !is_alike_from_both_ends(outlook) || is_sure_bird(outlook);
}

/// Of the box along the body's axes the share that the components' volumes have together.
double share_of_box(const Surface& surface, const Eigen::Matrix3d& axes) {
  const Positions places = surface.positions * axes.transpose();
  const Eigen::RowVector3d low = places.colwise().minCoeff();
  const Eigen::RowVector3d high = places.colwise().maxCoeff();
  double volume = 0;
  for (const auto& face : surface.triangles.rowwise()) {
    const Eigen::RowVector3d a = places.row(face[0]) - low;
    const Eigen::RowVector3d b = places.row(face[1]) - low;
    const Eigen::RowVector3d c = places.row(face[2]) - low;
    volume += a.dot(b.cross(c)) / 6;
  }
  const double box = (high - low).prod();
  return box > 0 ? std::abs(volume) / box : 0;
}

/// A trunk is no thicker than a ball, and limbs and necks stand out from it. A bus has corners.
bool fills_its_box(const Surface& surface, const Eigen::Matrix3d& axes) {
  constexpr double ball = std::numbers::pi / 6;  // of its box
  return share_of_box(surface, axes) > ball;
}

/// Places along a path, evenly, without its ends.
std::vector<Vector3d> places_along(const CurveTree& tree, const std::vector<int>& path) {
  constexpr int count = 15;
  std::vector<double> way{0};
  for (std::size_t k = 1; k < path.size(); ++k) {
    way.push_back(way.back() + (tree.nodes[idx(path[k])] - tree.nodes[idx(path[k - 1])]).norm());
  }
  std::vector<Vector3d> places;
  std::size_t next = 0;
  for (int k = 1; k <= count; ++k) {
    while (next + 1 < path.size() && way[next] < way.back() * k / (count + 1)) ++next;
    places.push_back(tree.nodes[idx(path[next])]);
  }
  return places;
}

/// The faces whose own boxes meet this one.
Surface faces_in(const Surface& surface, const Eigen::AlignedBox3d& box) {
  std::vector<int> kept;
  for (int f = 0; f < static_cast<int>(surface.triangles.rows()); ++f) {
    Eigen::AlignedBox3d own;
    for (const int v : surface.triangles.row(f)) {
      own.extend(surface.positions.row(v).transpose());
    }
    if (own.intersects(box)) kept.push_back(f);
  }
  return {surface.positions, surface.triangles(kept, Eigen::all)};
}

/// Some straight way from a leg to the same place of the other one leaves the surface. The lower
/// corners of a box have the box between them.
bool has_air_between(const Surface& placed, const Outlook& outlook, const LimbWay& legs) {
  const CurveTree& tree = outlook.sides == Sides::posed ? outlook.posed : outlook.tree;
  const std::vector<Vector3d> left = places_along(tree, legs.path);
  const std::vector<Vector3d> right = places_along(tree, legs.mirror);
  Eigen::AlignedBox3d box;
  for (std::size_t k = 0; k < left.size(); ++k) box.extend(left[k]).extend(right[k]);
  const Surface near = faces_in(placed, box);
  if (near.triangles.rows() == 0) return false;
  const SurfaceTree faces(near);
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Vector3d across = right[k] - left[k];
    const double length = across.norm();
    if (length > 0 && faces.ray(left[k], across / length, length).triangle >= 0) return true;
  }
  return false;
}

bool has_corners_for_legs(const Outlook& outlook, const Surface& surface) {
  if (outlook.found.legs.empty()) return false;
  const Surface placed{surface.positions * outlook.axes.transpose(), surface.triangles};
  return std::any_of(outlook.found.legs.begin(), outlook.found.legs.end(), [&](int pair) {
    return !has_air_between(placed, outlook, outlook.limbs.pairs[idx(pair)].ways.front());
  });
}

}  // namespace

bool has_body_of_tubes(const Outlook& outlook) {
  const CurveTree& tree = outlook.tree;
  const Limbs& limbs = outlook.limbs;
  const PlanFound& found = outlook.found;
  if (found.spreads_wings) {
    return tubes_but_for_wings(tree, limbs, found.arms) >= tube_share_needed;
  }
  if (found.plan != BodyKind::humanoid) return false;
  const int body = tree.component[idx(limbs.pairs[idx(found.legs.front())].root)];
  return tubes_among(tree, [&](int node) { return tree.component[idx(node)] == body; }) >=
         tube_share_needed;
}

std::string why_a_thing(const Outlook& outlook, const Surface& surface,
                        const PlanOptions& options) {
  if (outlook.found.plan == BodyKind::other) return "";
  if (fills_its_box(surface, outlook.axes)) {
    return "a body with limbs fills less of its box than a ball does; ";
  }
  if (has_corners_for_legs(outlook, surface)) {
    return "legs have air between them, and here all is filled; ";
  }
  // Humans may be put together, as dolls are, and may fold their hands.
  if (outlook.found.plan == BodyKind::humanoid) return "";
  if (!has_a_head(outlook)) {
    return "an animal has a head at one end, and this is alike from both; ";
  }
  if (is_put_together(outlook, surface, options)) {
    return "most of an animal is one component, which here is less than half; ";
  }
  return outlook.tree.cycles > 0 ? "the curve of an animal has no cycles, as this one has; " : "";
}

}  // namespace curveskel
