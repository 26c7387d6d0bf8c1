// The part of a blocked Householder QR that is too narrow for a device: one panel of columns.
#pragma once

#include <cstddef>

namespace curveskel {

/// Column-major, entry (i, j) at i + j * stride.
struct Panel {
  double* entries;
  std::size_t rows;
  std::size_t columns;
  std::size_t stride;
};

/// Eliminates the first `pivots` <= min(#rows, #columns) columns of `panel` by reflections: on and
/// above the diagonal they then hold R, below it the reflectors; the other columns go through the
/// same reflections. With `v` (#rows by #columns) and `w` (#columns by #rows), 0 beyond the pivots,
/// whatever stands beside the panel becomes Q^T A = A - v (w A). R. Schreiber and C. Van Loan, SIAM
/// J. Sci. Stat. Comput. 10, 1989. O(#rows #columns^2).
void eliminate(const Panel& panel, std::size_t pivots, const Panel& v, const Panel& w);

}  // namespace curveskel
