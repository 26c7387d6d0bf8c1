// Rotations and scales that lay points onto others.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/advanced/tree.hpp>

namespace curveskel {

/// to + scale * rotation * (point - from).
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< proper
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  double scale = 1;

  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& point) const {
    return to + scale * rotation * (point - from);
  }
};

/// The proper rotation for which the sum of |to - rotation from|^2 is least (W. Kabsch, 1976).
[[nodiscard]] Eigen::Matrix3d rotation_between(const Eigen::Matrix3Xd& from,
                                               const Eigen::Matrix3Xd& to);

/// Lays the points onto the surface by rounds of nearest points (P. Besl and N. McKay, A method for
/// registration of 3-D shapes, 1992), the farthest fifth of them left out in each; the scale stays.
void refine(Similarity& motion, const Eigen::Matrix3Xd& points, const SurfaceTree& surface,
            int rounds);

/// The mean distance of the nearest four fifths of the points.
[[nodiscard]] double misfit(const Similarity& motion, const Eigen::Matrix3Xd& points,
                            const SurfaceTree& surface);

}  // namespace curveskel
