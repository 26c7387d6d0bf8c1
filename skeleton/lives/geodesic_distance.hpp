// Distances along a surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stop_token>
#include <vector>

#include <curveskel/surface.hpp>
#include "base/buckets.hpp"

namespace curveskel {

/// Fast marching over the triangles of a surface (Kimmel and Sethian 1998): the distance at a
/// corner follows from those at the other two as if they came from a point in the triangle's plane;
/// where that point is not seen through the triangle, along its edges.
class GeodesicDistance {
 public:
  explicit GeodesicDistance(const Surface& surface);

  /// n, in the surface's units; infinite where no way leads. O(n). May be called from several
  /// threads. Throws Cancelled soon after a stop was requested.
  [[nodiscard]] Eigen::VectorXf from(int vertex, const std::stop_token& stop = {}) const;

 private:
  class Front;
  /// A corner of a triangle, seen from the edge across: in the plane where that edge goes from
  /// (0, 0), the next corner's place, to (length, 0), the one's after that.
  struct Corner {
    float length;
    float x;
    float y;
  };

  /// A triangle at a vertex, as one reads them in a row: its other corners, each seen from the edge
  /// between the vertex and the other.
  struct Wedge {
    std::int32_t next;
    std::int32_t last;
    Corner at_next;
    Corner at_last;
  };
  Buckets<Wedge> wedges_around_;  // by vertex
  float step_ = 1;                // of the front
  std::size_t steps_ = 1;         // that the front is wide
};

/// n, the mean over the surface of the geodesic distance from each vertex: by `samples` vertices
/// far from each other, each for the part of the surface that is nearest to it. `areas`: n, of the
/// vertices. Precondition: one component. O(samples n). Throws
/// Cancelled soon after a stop was requested.
[[nodiscard]] Eigen::VectorXd mean_geodesic_distance(const Surface& surface,
                                                     const Eigen::VectorXd& areas, int samples,
                                                     int threads, const std::stop_token& stop);

}  // namespace curveskel
