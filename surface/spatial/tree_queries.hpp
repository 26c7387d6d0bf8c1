// The queries of SurfaceTree in the tree's local frame. Internal to surface/.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

/// No surface met, in a query's local units.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct LocalNearest {
  Eigen::Vector3d point;
  int triangle = -1;  ///< -1 = none within the limit
};
[[nodiscard]] LocalNearest find_nearest(const WideTree& tree, const Eigen::Vector3d& p,
                                        double limit);

struct LocalHit {
  double distance = infinity;
  int triangle = -1;
};
[[nodiscard]] LocalHit find_hit(const WideTree& tree, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction, double limit);

/// find_hit's distances for directions normal to `normal`, each turned by the inverse of `rotation`
/// first.
void find_distances_in_plane(const WideTree& tree, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& normal,
                             std::span<const Eigen::Vector3d> directions,
                             const Eigen::Matrix3d& rotation, double limit,
                             std::span<double> distances);

/// The triangles in leaves that the plane through p comes near, ascending.
[[nodiscard]] std::vector<int> find_near_plane(const WideTree& tree, const Eigen::Vector3d& p,
                                               const Eigen::Vector3d& normal);

/// True if a triangle that the segment does not cross lies within `near` of it.
[[nodiscard]] bool comes_near(const WideTree& tree, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to, double near);

/// True if the surface winds around p a non-zero number of times.
[[nodiscard]] bool winds_around(const WideTree& tree, const Eigen::Vector3d& p);

/// Radius of the largest ball that touches p with its centre along n; infinity if nothing bounds it
/// below 1.
[[nodiscard]] double find_ball_radius(const WideTree& tree, const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& n, double min_sine);

}  // namespace curveskel
