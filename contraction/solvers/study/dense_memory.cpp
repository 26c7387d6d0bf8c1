#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <curveskel/error.hpp>
#include "base/memory.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

std::string gigabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f GB", bytes / 1e9);
  return text.data();
}

}  // namespace

void require_memory(std::string_view solver, const SparseMatrix& a, double copies) {
  const double bytes_per_entry = copies * sizeof(double);
  const double columns = static_cast<double>(a.cols());
  const double needed = bytes_per_entry * static_cast<double>(a.rows()) * columns;
  const double present = available_memory_bytes();
  if (needed <= present) return;
  const double rows_per_column = static_cast<double>(a.rows()) / columns;
  const double fits = std::sqrt(present / (bytes_per_entry * rows_per_column));
  throw Error(Fault::solver, std::string(solver) + ": a system of " + std::to_string(a.cols()) +
                                 " unknowns needs " + gigabytes(needed) + " and " +
                                 gigabytes(present) + " are there; use at most " +
                                 std::to_string(static_cast<long>(fits)) +
                                 " vertices (--resolution) or the solver cholesky");
}

}  // namespace curveskel
