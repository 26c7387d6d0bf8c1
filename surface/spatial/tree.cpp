#include <curveskel/advanced/tree.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/error.hpp>
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

/// The hierarchy, and where its local frame lies in the frame of the queries.
struct SurfaceTree::Implementation {
  std::shared_ptr<const WideTree> tree;
  Eigen::Vector3d centre;                                  // of the local frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // columns: the local axes
  double scale = 1;                                        // local units per unit

  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& point) const {
    return direction_to_local(point - centre) * scale;
  }
  [[nodiscard]] Eigen::Vector3d direction_to_local(const Eigen::Vector3d& direction) const {
    return rotation.transpose() * direction;
  }
  [[nodiscard]] Eigen::Vector3d from_local(const Eigen::Vector3d& local) const {
    return rotation * (local / scale) + centre;
  }
};

SurfaceTree::SurfaceTree(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
SurfaceTree::SurfaceTree(const Surface& surface, int threads)
    : implementation_(std::make_unique<Implementation>()) {
  require_sound(surface, "SurfaceTree");
  auto tree = std::make_shared<const WideTree>(build_wide_tree(surface, threads));
  implementation_->centre = tree->centre;
  implementation_->scale = tree->scale;
  implementation_->tree = std::move(tree);
}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

const SurfaceTree::Implementation& SurfaceTree::whole() const {
  if (implementation_) return *implementation_;
  throw Error(Fault::usage,
              "SurfaceTree: found one that was moved from, needed one with a surface: ask the one "
              "that it was moved to");
}

SurfaceTree SurfaceTree::in_frame(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin,
                                  double scale) const {
  const Implementation& here = whole();
  if (!(scale > 0) || !std::isfinite(scale) || !rotation.allFinite() || !origin.allFinite()) {
    throw Error(Fault::usage, "SurfaceTree::in_frame: found the scale " + std::to_string(scale) +
                                  ", or a number that is not finite, needed a scale above 0 and "
                                  "finite numbers");
  }
  auto moved = std::make_unique<Implementation>(here);
  moved->centre = origin + scale * rotation * here.centre;
  moved->rotation = rotation * here.rotation;
  moved->scale = here.scale / scale;
  return SurfaceTree(std::move(moved));
}

SurfaceTree::Nearest SurfaceTree::nearest(const Eigen::Vector3d& point, double limit) const {
  const Implementation& here = whole();
  const Eigen::Vector3d p = here.to_local(point);
  const LocalNearest nearest = find_nearest(*here.tree, p, limit * here.scale);
  if (nearest.triangle < 0) return {point};
  return {here.from_local(nearest.point), (nearest.point - p).norm() / here.scale,
          nearest.triangle};
}

SurfaceTree::Hit SurfaceTree::ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  double limit) const {
  const Implementation& here = whole();
  const LocalHit hit = find_hit(*here.tree, here.to_local(origin),
                                here.direction_to_local(direction), limit * here.scale);
  if (hit.triangle < 0) return {};
  return {hit.distance / here.scale, hit.triangle};
}

void SurfaceTree::rays_in_plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal,
                                std::span<const Eigen::Vector3d> directions, double limit,
                                std::span<double> distances) const {
  const Implementation& here = whole();
  if (directions.size() != distances.size()) {
    throw Error(Fault::usage, "SurfaceTree::rays_in_plane: found places for " +
                                  std::to_string(distances.size()) + " distances, needed one for " +
                                  "each of " + std::to_string(directions.size()) + " directions");
  }
  find_distances_in_plane(*here.tree, here.to_local(origin), here.direction_to_local(normal),
                          directions, here.rotation, limit * here.scale, distances);
  for (double& distance : distances) distance /= here.scale;
}

std::vector<int> SurfaceTree::near_plane(const Eigen::Vector3d& point,
                                         const Eigen::Vector3d& normal) const {
  const Implementation& here = whole();
  return find_near_plane(*here.tree, here.to_local(point), here.direction_to_local(normal));
}

bool SurfaceTree::comes_near(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                             double distance) const {
  const Implementation& here = whole();
  return curveskel::comes_near(*here.tree, here.to_local(from), here.to_local(to),
                               distance * here.scale);
}

bool SurfaceTree::inside(const Eigen::Vector3d& point) const {
  const Implementation& here = whole();
  return winds_around(*here.tree, here.to_local(point));
}

double SurfaceTree::inscribed_radius(const Eigen::Vector3d& point) const {
  const double distance = nearest(point).distance;
  return inside(point) ? distance : -distance;
}

double SurfaceTree::inscribed_radius(const Eigen::Vector3d& point, const Ball& inner) const {
  const double off_centre = (point - inner.centre).norm();
  if (!(off_centre < inner.radius)) return inscribed_radius(point);
  constexpr double slack = 1 + 1e-9;  // for rounding
  const Nearest found = nearest(point, (inner.radius + off_centre) * slack);
  // A radius of a few last digits of the coordinates is known no better than by these.
  return found.triangle >= 0 ? found.distance : inscribed_radius(point);
}

SurfaceTree::Ball SurfaceTree::inscribed_ball(const Eigen::Vector3d& point,
                                              const Eigen::Vector3d& inward_normal,
                                              double min_sine) const {
  const Implementation& here = whole();
  const double radius = find_ball_radius(*here.tree, here.to_local(point),
                                         here.direction_to_local(inward_normal), min_sine) /
                        here.scale;
  return {point + radius * inward_normal, radius};
}

}  // namespace curveskel
