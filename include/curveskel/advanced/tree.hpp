// Distance, ray, plane, inside and inscribed-ball queries against a surface.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// A bounding volume hierarchy over the triangles of a closed surface. Immutable after
/// construction; queries are const and may run from several threads at once. Keeps its own copy of
/// the triangles. Results do not depend on the number of threads. One that was moved from answers
/// each query by Error(Fault::usage) until another is assigned to it.
class SurfaceTree {
 public:
  /// O(#F log #F), on at most `threads` threads, 0 = one per core. Precondition: at least one face.
  explicit SurfaceTree(const Surface& surface, int threads = 1);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;
  SurfaceTree(const SurfaceTree&) = delete;
  SurfaceTree& operator=(const SurfaceTree&) = delete;

  /// The same tree for the surface's copy at origin + scale * rotation * position (a similarity;
  /// scale > 0). Shares the hierarchy with this one: no time, no memory. Throws Error(Fault::usage)
  /// for numbers that are not finite, and for another scale.
  [[nodiscard]] SurfaceTree in_frame(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin,
                                     double scale) const;

  struct Nearest {
    Eigen::Vector3d point;  ///< the closest point of the surface
    double distance = std::numeric_limits<double>::infinity();  ///< >= 0, in model units
    int triangle = -1;  ///< -1 if nothing lies within the given limit
  };
  /// The closest surface point within `limit` of `point`.
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& point,
                                double limit = std::numeric_limits<double>::infinity()) const;

  struct Hit {
    double distance = std::numeric_limits<double>::infinity();  ///< along the unit direction
    int triangle = -1;                                          ///< -1 = no hit
  };
  /// First hit of the ray from `origin` along the unit vector `direction` with distance > 0 and
  /// <= limit. Watertight (Woop et al. 2013): no ray slips between two triangles that share an
  /// edge.
  [[nodiscard]] Hit ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                        double limit = std::numeric_limits<double>::infinity()) const;

  /// The distances of `ray` in several directions that are all normal to `normal`, up to rounding:
  /// at half the cost or less for a dozen of them. `distances` has one place for each direction, or
  /// Error(Fault::usage) is thrown.
  void rays_in_plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal,
                     std::span<const Eigen::Vector3d> directions, double limit,
                     std::span<double> distances) const;

  /// Numbers of all triangles that the plane through `point` crosses or touches, ascending, and of
  /// few that it misses. Cost: linear in their number.
  [[nodiscard]] std::vector<int> near_plane(const Eigen::Vector3d& point,
                                            const Eigen::Vector3d& normal) const;

  /// True if a point of the straight line between two points lies within `distance` of the surface.
  /// Precondition: the line does not cross the surface, see `ray`. About the cost of a ray where
  /// the distance is small.
  [[nodiscard]] bool comes_near(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                double distance) const;

  /// True if the surface winds around the point a non-zero number of times. Exact up to rounding at
  /// the surface itself: a ray that passes too close to an edge is retried in another fixed
  /// direction.
  [[nodiscard]] bool inside(const Eigen::Vector3d& point) const;

  struct Ball {
    Eigen::Vector3d centre;
    double radius = 0;  ///< infinity if no surface point bounds the ball to less than D or a
                        ///< little more, 2 D at most
  };
  /// Distance to the surface, positive inside and negative outside.
  [[nodiscard]] double inscribed_radius(const Eigen::Vector3d& point) const;
  /// The same at half the cost for a point within a ball that lies inside the surface.
  [[nodiscard]] double inscribed_radius(const Eigen::Vector3d& point, const Ball& inner) const;

  /// The largest ball inside the surface that touches it at `point`: r = min |e|^2 / (2 n.e) over
  /// surface points q, e = q - point, n the unit inward normal; q seen under less than
  /// asin(min_sine) above the tangent plane are skipped as noise (shrinking ball, Ma et al. 2012).
  /// Points within edges and faces (where the growing ball first meets each) count only when seen
  /// under at least 30 degrees: below that the chords of a curved surface bound the ball too early.
  /// At most 0.5 % larger than the minimum. One traversal, no iteration.
  [[nodiscard]] Ball inscribed_ball(const Eigen::Vector3d& point,
                                    const Eigen::Vector3d& inward_normal,
                                    double min_sine = 0.17364817766693033) const;

 private:
  struct Implementation;
  explicit SurfaceTree(std::unique_ptr<Implementation> implementation);
  [[nodiscard]] const Implementation& whole() const;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace curveskel
