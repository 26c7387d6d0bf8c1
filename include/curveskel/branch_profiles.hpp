// Sections of the surface across the branches of its skeleton.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct ProfileOptions {
  double spacing = 0;  ///< along the branch, in model units, or the next smaller that divides it;
                       ///< 0 = a section at each node
  int threads = 0;     ///< at most; 0 = one per core. The result does not depend on it.
  /// The vertices round each hole that was closed (`RepairedSurface::rims`): the faces that close
  /// it are no surface for the inscribed radius.
  std::vector<std::vector<std::int32_t>> rims = {};
};

/// Lengths in model units. The section is that part of the plane through `position`, normal to
/// `tangent`, that lies within the surface and around `position`: the area inside its outer loop
/// less the holes. Its numbers are NaN where `position` lies outside of the surface.
struct BranchSection {
  int branch = 0;                                      ///< of `branches(skeleton)`
  double s = 0;                                        ///< along the branch from its start
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the curve
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();   ///< unit, towards the branch's end
  double inscribed_radius = 0;  ///< from `position` to the surface, that which closes holes left
                                ///< out; negative outside
  double area = 0;
  double perimeter = 0;            ///< of the outer loop and of the holes
  double equivalent_diameter = 0;  ///< of the circle of the same area
  /// 1 - b / a of the ellipse with the same second moments, half axes a >= b: 0 = as a circle.
  double ellipticity = 0;
  /// The section may belong to several branches: `position` lies in the inscribed ball of a
  /// junction at the branch's ends, another branch passes through the section, or, where there is
  /// a vertex map, a tenth of the perimeter lies on faces of others (`branch_territories`).
  bool near_junction = false;
};

/// Branch by branch, from start to end. Preconditions: closed, oriented surface around the
/// skeleton. Throws Error(Fault::usage) for a negative spacing or one that makes more than 10^7
/// sections, Cancelled on a stop. O(#F log #F), and for each section linear in the triangles that
/// its plane crosses and in #E.
[[nodiscard]] std::vector<BranchSection> branch_profiles(const Surface& surface,
                                                         const CurveSkeleton& skeleton,
                                                         const ProfileOptions& options = {},
                                                         const Monitor& monitor = {});

}  // namespace curveskel
