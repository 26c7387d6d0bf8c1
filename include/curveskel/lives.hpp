// How clearly each tip of a surface is one: a number without scale, from the surface alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct LifeOptions {
  int samples = 32;             ///< of the surface, for the mean distance; 8..1000
  double least_height = 0.008;  ///< of D, of a tip over its saddle: what is lower is noise; 0..1
  int threads = 0;              ///< at most, 0 = one per core; the result does not depend on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const LifeOptions& options);

/// A part of the surface that sticks out.
struct TipLife {
  int vertex = -1;   ///< of the surface: the tip
  double life = 0;   ///< see `tip_lives`
  double birth = 0;  ///< the function there, in D
  double death = 0;  ///< at the saddle, in D; of the eldest the function's least value
  int parent = -1;   ///< number of the tip into whose part it merges there; -1 = the eldest
  int saddle = -1;   ///< vertex
  Eigen::Vector3d rim =
      Eigen::Vector3d::Zero();  ///< centre of the level curve at which the life is attained
  double rim_radius = 0;        ///< its mean distance from there
  double area = 0;              ///< of the part above that curve, of the surface's
};

/// The maxima of the mean geodesic distance f to the surface's points, by descending life. Sweeping
/// down from the highest value, each maximum has a part of the surface, which dies where it meets
/// that of a higher one (elder rule). The life is the largest value, over the level curves t of the
/// part from f's maximum down to that death, of (f(max) - t) over the mean distance of the level
/// curve from its centre: about the length of a limb over its radius where it begins. Level curves
/// count where the part is a disc of eight vertices or more and at most half of the surface, from
/// a fifth of the way down on. Births and deaths change by no more than f does (Cohen-Steiner,
/// Edelsbrunner and Harer 2007); no junction, ball or triangle enters.
/// Precondition: closed manifold, one component. Throws Cancelled on a stop. O(samples n), and
/// for each tip O(m log m) of the m vertices of its part, at most half of them all.
[[nodiscard]] std::vector<TipLife> tip_lives(const Surface& surface,
                                             const LifeOptions& options = {},
                                             const Monitor& monitor = {});

}  // namespace curveskel
