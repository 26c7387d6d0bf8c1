// One branch as a curve over its length.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

/// A polyline of at least two points; places on it have the length from its start.
struct BranchCurve {
  Positions points;             ///< of the nodes, in order
  std::vector<double> lengths;  ///< from the start to each point
  Eigen::VectorXd radii;        ///< of the nodes, or empty
  bool closed = false;          ///< the last point is the first

  [[nodiscard]] double length() const { return lengths.back(); }
};
[[nodiscard]] BranchCurve branch_curve(const CurveSkeleton& skeleton, const Branch& branch);

/// The point of the polyline at `s`, which goes round on a closed one and stops at the ends of
/// others. O(log n).
[[nodiscard]] Eigen::Vector3d point_at(const BranchCurve& curve, double s);
/// Linear between nodes, in the same way; NaN without radii.
[[nodiscard]] double radius_at(const BranchCurve& curve, double s);

/// Derivatives by the length.
struct CurveDerivatives {
  Eigen::Vector3d first;
  Eigen::Vector3d second;
  Eigen::Vector3d third;
};
/// Of the cubic that is nearest (least squares) to the nodes within two inscribed radii, or the
/// length `least_half`, on either side, or to the next three if these are fewer: what is shorter is
/// no bend of the curve.
[[nodiscard]] CurveDerivatives derivatives_at(const BranchCurve& curve, double s,
                                              double least_half = 0);

/// The unit direction in which the branch leaves its start, or its end: with s the length after
/// which its own inscribed ball has left that of the node there, from 1.5 s to 3 s, as far as it
/// goes. Nearer, the body is still one with its siblings', and the curve a matter of the junction.
/// Of a branch that stays in the ball its whole chord, of a closed one and without radii the first
/// edge. Zero where the branch has no length.
[[nodiscard]] Eigen::Vector3d departure(const BranchCurve& curve, bool at_start);

}  // namespace curveskel
