// What this project asks of ViennaCL (K. Rupp et al., SIAM J. Sci. Comput. 38, 2016). ViennaCL's QR
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

/// Householder QR on the device. What comes back has R on and above the diagonal; the last columns
/// go through the same reflections, so that [A B] gives R and the first rows of Q^T B.
[[nodiscard]] Matrix reduced(const Matrix& a);

struct Factors {
  Matrix q;  ///< rows x rows
  Matrix r;  ///< rows x columns
};
/// The same with Q formed, on the host, from the reflections.
[[nodiscard]] Factors factorised(const Matrix& a);

/// Compressed rows of a symmetric positive definite matrix.
struct SparseRows {
  std::size_t rows = 0;
  std::vector<unsigned> start, column;
  std::vector<double> value;
};

struct KrylovResult {
  std::vector<double> x;
  int iterations = 0;
};

/// Conjugate gradients for H x = r on the device, until the preconditioned residual has shrunk by
/// `tolerance`, or for `most_iterations`. The preconditioner is M^-2 with M given (an empty one:
/// the diagonal of H); each application solves twice with M, by conjugate gradients with M's
/// diagonal. `stop` is asked once an iteration; when it says true the iteration ends early.
[[nodiscard]] KrylovResult conjugate_gradients(const SparseRows& h, const SparseRows& m,
                                               const std::vector<double>& r, double tolerance,
                                               int most_iterations,
                                               const std::function<bool()>& stop);

}  // namespace curveskel::vcl
