// The rates at which the classical iterations converge, estimated before they are run.
#pragma once

#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {

/// Extreme eigenvalues of D^-1 H (D the diagonal of H), as far as Lanczos' iteration has found
/// them: the true ones lie at or beyond these.
struct Spectrum {
  double least = 1;
  double largest = 1;

  /// Of Jacobi's iteration, at least.
  [[nodiscard]] double jacobi_radius() const;
  /// Of the extrapolated iteration (JOR), at least, with the relaxation 2 / (least + largest), with
  /// which it is fastest.
  [[nodiscard]] double jor_radius() const;
};

/// `steps` products with H, symmetric with positive diagonal (both triangles stored). The largest
/// eigenvalue is good to some percent after 40 steps; the least needs more, the smaller it is.
/// Deterministic.
[[nodiscard]] Spectrum jacobi_spectrum(const SparseMatrix& h, int steps, const Monitor& monitor);

/// Iterations that shrink an error by `factor` < 1 at this spectral radius; infinity from 1 on.
[[nodiscard]] double iterations_for(double factor, double radius);

}  // namespace curveskel
