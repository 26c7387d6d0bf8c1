// The prominence of a part of the surface, for any triangles and groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// A protrusion: its prominence, the middle of its boundary, and that of its cap: all of its
/// triangles that are farther from there than four fifths of the height.
struct Protrusion {
  double prominence = 0;
  Eigen::Vector3d boundary_centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d cap_centre = Eigen::Vector3d::Zero();  ///< by area
};

/// Sweeps the surface from an apex towards a base. Keeps its memory from sweep to sweep.
class ProminenceSweep {
 public:
  explicit ProminenceSweep(const WorkingSurface& working);  ///< kept by reference

  /// Spheres about `base` cut off what lies farther out, together with the vertex `apex`. The
  /// prominence is the largest height of such a part, from the middle of its boundary, over the
  /// mean radius of its boundary. A part counts as long as it holds vertices with `is_own` only,
  /// once it holds `least_vertices` and is a fifth of the way from the apex to the base, so that
  /// the triangles' size does not matter; 0 if none counts. Ends as soon as `enough` is reached.
  /// O(n log n) in the vertices passed.
  [[nodiscard]] Protrusion operator()(const Eigen::Vector3d& base, int apex,
                                      const std::function<bool(int)>& is_own, double enough,
                                      std::size_t least_vertices = 1);

 private:
  struct Boundary {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0;  ///< mean distance from the centre, by length
  };
  void take(int vertex);
  [[nodiscard]] std::span<const std::int32_t> around(int vertex) const;
  [[nodiscard]] Boundary boundary_at(double depth) const;
  [[nodiscard]] Protrusion protrusion_at(double depth) const;
  [[nodiscard]] Eigen::Vector3d cap_centre(const Protrusion& part) const;
  void forget();

  const Surface& surface_;
  const Buckets<std::int32_t>& triangles_around_;
  std::vector<double> depth_;        // per vertex, below the apex's sphere; < 0 = not seen
  std::vector<char> taken_;          // per vertex
  std::vector<char> taken_corners_;  // per triangle
  // Left by one sweep for the next to clear.
  std::vector<int> seen_;
  std::vector<int> part_;     // vertices taken
  std::vector<int> touched_;  // triangles with a corner taken
};

}  // namespace curveskel
