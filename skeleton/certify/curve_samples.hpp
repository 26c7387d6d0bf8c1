// Points at even steps along a skeleton's branches, measured by the certificate.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

struct CurveSample {
  Eigen::Vector3d position;
  Eigen::Vector3d tangent;  ///< unit, of the chord over `tangent_length` about the sample
  double length = 0;        ///< of the branch that the sample stands for, in model units
  int branch = 0;
  int segment = 0;  ///< between the branch's nodes `segment` and `segment` + 1
};

/// The positions of a branch's nodes.
[[nodiscard]] std::vector<Eigen::Vector3d> polyline(const CurveSkeleton& skeleton,
                                                    const Branch& branch);

[[nodiscard]] double polyline_length(const std::vector<Eigen::Vector3d>& line);

/// The points at the given arc lengths, which ascend; clamped to the line's ends. `segments` gets
/// the number of the line's segment that each lies on.
[[nodiscard]] std::vector<Eigen::Vector3d> points_along(const std::vector<Eigen::Vector3d>& line,
                                                        const std::vector<double>& arc_lengths,
                                                        std::vector<int>* segments = nullptr);

/// Each branch is cut into equal pieces of at most `spacing` with a sample in the middle of each,
/// so it matters little how finely a branch is divided into edges. A branch of no length has one
/// sample. Samples follow their branches. Lengths are in model units.
/// Throws Error(Fault::input) where that makes more than ten million: the skeleton is in another
/// unit than the spacing.
[[nodiscard]] std::vector<CurveSample> sample_branches(const CurveSkeleton& skeleton,
                                                       const std::vector<Branch>& branches,
                                                       double spacing, double tangent_length);

}  // namespace curveskel
