// The centre of a patch by its least-squares problem: min ||mu L X||^2 + ||X - V||^2.
#pragma once

#include <Eigen/Core>

#include <curveskel/surface.hpp>
#include "contraction/fairing/patches.hpp"

namespace curveskel {

/// All three return how far the centre moves, in the unit of `positions`; `smoothing` is mu. They
/// agree to about 1e-14 times the patch's extent.

/// The reference: Eigen's Householder QR of the 2n by n matrix. O(n^3), 10 n^3 / 3 operations.
[[nodiscard]] Eigen::RowVector3d centre_step_by_full_qr(const Patch& patch,
                                                        const Positions& positions,
                                                        double smoothing);

/// The same factorisation in (n + 1) by (n + 3) numbers and 2 n^3 operations, as the rows of the
/// identity come in one at a time (docs/study/fairing.md, "The QR").
[[nodiscard]] Eigen::RowVector3d centre_step_by_qr(const Patch& patch, const Positions& positions,
                                                   double smoothing);

/// Re[(I + i mu L)^-1 V] by a sparse complex LU: for patches of more than some hundred vertices.
[[nodiscard]] Eigen::RowVector3d centre_step_by_lu(const Patch& patch, const Positions& positions,
                                                   double smoothing);

/// By QR, or by LU where that takes less time.
[[nodiscard]] Eigen::RowVector3d centre_step(const Patch& patch, const Positions& positions,
                                             double smoothing);

}  // namespace curveskel
