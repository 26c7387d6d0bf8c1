#include "surface/tree.hpp"

#include "surface/tree_queries.hpp"
#include "surface/wide_tree.hpp"

namespace curveskel {

struct SurfaceTree::Implementation {
  WideTree tree;
};

SurfaceTree::SurfaceTree(const Surface& surface)
    : implementation_(std::make_unique<Implementation>(Implementation{build_wide_tree(surface)})) {}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

SurfaceTree::Nearest SurfaceTree::nearest(const Eigen::Vector3d& point, double limit) const {
  const WideTree& tree = implementation_->tree;
  const Eigen::Vector3d p = tree.to_local(point);
  const LocalNearest nearest = find_nearest(tree, p, limit * tree.scale);
  if (nearest.triangle < 0) return {point};
  return {tree.to_model(nearest.point), (nearest.point - p).norm() / tree.scale, nearest.triangle};
}

SurfaceTree::Hit SurfaceTree::ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  double limit) const {
  const WideTree& tree = implementation_->tree;
  const LocalHit hit = find_hit(tree, tree.to_local(origin), direction, limit * tree.scale);
  if (hit.triangle < 0) return {};
  return {hit.distance / tree.scale, hit.triangle};
}

bool SurfaceTree::inside(const Eigen::Vector3d& point) const {
  return winds_around(implementation_->tree, implementation_->tree.to_local(point));
}

double SurfaceTree::inscribed_radius(const Eigen::Vector3d& point) const {
  const double distance = nearest(point).distance;
  return inside(point) ? distance : -distance;
}

SurfaceTree::Ball SurfaceTree::inscribed_ball(const Eigen::Vector3d& point,
                                              const Eigen::Vector3d& inward_normal,
                                              double min_sine) const {
  const WideTree& tree = implementation_->tree;
  const double radius =
      find_ball_radius(tree, tree.to_local(point), inward_normal, min_sine) / tree.scale;
  return {point + radius * inward_normal, radius};
}

}  // namespace curveskel
