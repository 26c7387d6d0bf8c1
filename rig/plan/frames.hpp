// Frames in which a body may stand or lie: rows x (to its left), up and front.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/body_plan.hpp>

namespace curveskel {

/// The usual one first. Throws Error(usage) where up and front are one direction.
[[nodiscard]] std::vector<Eigen::Matrix3d> frames_of(const PlanOptions& options);

/// Precondition: `axis` is one of a frame's.
[[nodiscard]] Direction direction_of(const Eigen::Vector3d& axis);

/// Those of a body whose up is none of a file's usual directions; none where up is given. Up is
/// never -y: few bodies lie so in files whose up is z, and chairs upside down have arms and legs.
[[nodiscard]] std::vector<Eigen::Matrix3d> frames_of_lying(const PlanOptions& options);

}  // namespace curveskel
