// Blocked Householder QR whose products run on a device by ViennaCL (K. Rupp et al., SIAM J. Sci.
// Comput. 38, 2016). ViennaCL's own QR takes the same panels, but works on them and forms Q entry
// by entry on the host, and its row-major matrices come out wrong past the first panel (1.7.1).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace curveskel::vcl {

/// Makes ViennaCL run on this device (cl_context, cl_device_id, cl_command_queue; they must outlive
/// its use). The first call counts: ViennaCL keeps one current context per process.
void use(void* context, void* device, void* queue);

/// Column-major, entry (i, j) at i + j * rows.
struct Matrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> entries;

  double& operator()(std::size_t i, std::size_t j) { return entries[i + j * rows]; }
  double operator()(std::size_t i, std::size_t j) const { return entries[i + j * rows]; }
};

/// The first `eliminated` rows of Q^T A, Q from the Householder QR of the first `eliminated`
/// columns on the device (at most #rows): R and, in the other columns, Q^T times what they held. Q
/// is not formed. Rows that no entry has reached yet are left out, which for eq. 3, [W_L L; W_H],
/// saves two fifths of the work. `before_panel` is called every few columns; what it throws ends
/// the work.
[[nodiscard]] Matrix reduced(const Matrix& a, std::size_t eliminated,
                             const std::function<void()>& before_panel);

struct Factors {
  Matrix q;  ///< rows x columns: the first columns of Q, orthonormal
  Matrix r;  ///< columns x columns, upper triangular
};
/// The same Householder QR of all columns, rows >= columns, with those columns of Q formed that A =
/// Q R needs: the reflections of all panels, kept on the host, go backwards over the identity on
/// the device. As much work again as R.
[[nodiscard]] Factors factorised(const Matrix& a, const std::function<void()>& before_panel);

}  // namespace curveskel::vcl
