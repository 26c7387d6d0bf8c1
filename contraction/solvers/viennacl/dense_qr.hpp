// The part of ViennaCL that is used here (K. Rupp et al., SIAM J. Sci. Comput. 38, 2016). Its QR
// does not compile as C++20, so this header is clean C++17 and its .cpp file is compiled as such.
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
  Matrix q;  ///< rows x rows
  Matrix r;  ///< rows x columns
};
/// Householder QR on the device with Q formed, on the host, from the reflections.
[[nodiscard]] Factors factorised(const Matrix& a);

}  // namespace curveskel::vcl
