// Gauss-Seidel on the normal equations, on the OpenCL device: rows of one colour at once.
// Y. Saad, Iterative Methods for Sparse Linear Systems, 2003, section 12.4.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "contraction/device/opencl.hpp"
#include "contraction/solvers/study/iteration.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

/// The smallest colour that no row before it with a common entry has.
std::vector<int> colours_of(const SparseMatrix& h) {
  std::vector<int> colour(idx(h.cols()), -1);
  std::vector<Eigen::Index> taken_by;  // the last row that found the colour taken
  for (Eigen::Index i = 0; i < h.cols(); ++i) {
    for (SparseMatrix::InnerIterator entry(h, i); entry; ++entry) {
      const int other = colour[idx(entry.row())];
      if (other >= 0) taken_by[idx(other)] = i;
    }
    int free = 0;
    while (idx(free) < taken_by.size() && taken_by[idx(free)] == i) ++free;
    if (idx(free) == taken_by.size()) taken_by.push_back(-1);
    colour[idx(i)] = free;
  }
  return colour;
}

/// The rows of H colour by colour, as the kernel wants them.
struct ColouredRows {
  std::vector<int> first;  // of each colour, and the end
  std::vector<int> row, start, column;
  std::vector<double> value, reciprocal;

  explicit ColouredRows(const SparseMatrix& h) : row(idx(h.cols())) {
    const std::vector<int> colour = colours_of(h);
    std::iota(row.begin(), row.end(), 0);
    std::stable_sort(row.begin(), row.end(),
                     [&](int a, int b) { return colour[idx(a)] < colour[idx(b)]; });
    start.push_back(0);
    for (const int i : row) {
      while (static_cast<int>(first.size()) <= colour[idx(i)]) {
        first.push_back(static_cast<int>(reciprocal.size()));
      }
      for (SparseMatrix::InnerIterator entry(h, i); entry; ++entry) {
        if (entry.row() == i) {
          reciprocal.push_back(1 / entry.value());
          continue;
        }
        column.push_back(static_cast<int>(entry.row()));
        value.push_back(entry.value());
      }
      start.push_back(static_cast<int>(column.size()));
    }
    first.push_back(static_cast<int>(row.size()));
    if (column.empty()) {  // no device has empty buffers
      column.push_back(0);
      value.push_back(0);
    }
  }
};

class GaussSeidel final : public LeastSquaresBackend {
 public:
  explicit GaussSeidel(const SolverOptions& options)
      : options_(options),
        session_(choose_device(devices(), {.double_precision = true}, "the solver gauss-seidel",
                               "use the solver cholesky")),
        kernel_(
            session_.build(gauss_seidel_source, "", options.program_cache).kernel("gauss_seidel")) {
  }

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    return iterate(normal_equations(a, b), monitor);
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return iterate({h, r}, monitor);
  }

 private:
  void sweep(const ColouredRows& rows) {
    constexpr std::size_t group = 64;
    for (std::size_t c = 0; c + 1 < rows.first.size(); ++c) {
      const int count = rows.first[c + 1] - rows.first[c];
      kernel_.set(x_, r_, row_, start_, column_, value_, reciprocal_, rows.first[c], count);
      session_.launch(kernel_, (idx(count) + group - 1) / group * group, group);
    }
  }

  void upload(const ColouredRows& rows, const NormalEquations& system) {
    row_ = session_.upload(rows.row);
    start_ = session_.upload(rows.start);
    column_ = session_.upload(rows.column);
    value_ = session_.upload(rows.value);
    reciprocal_ = session_.upload(rows.reciprocal);
    r_ = session_.upload(system.r);
    x_ = session_.upload(Positions(Positions::Zero(system.r.rows(), 3)));
  }

  Solution iterate(const NormalEquations& system, const Monitor& monitor) {
    require_positive_diagonal("gauss-seidel", system.h);
    const double size = system.r.norm();
    Solution solution;
    solution.x = Positions::Zero(system.r.rows(), 3);
    if (!(size > 0)) return solution;
    const ColouredRows rows(system.h);
    upload(rows, system);
    Convergence convergence("gauss-seidel", options_);
    for (int sweeps = 0;;) {
      // The residual costs as much as a sweep.
      const int stretch = std::clamp(sweeps / 8, 1, 100);
      for (int k = 0; k < stretch; ++k) {
        throw_if_stopped(monitor.stop);
        sweep(rows);
        session_.finish();
      }
      sweeps += stretch;
      session_.read(x_, solution.x.data(), idx(solution.x.size()) * sizeof(double));
      const Positions rest = system.r - system.h * solution.x;
      solution.iterations = sweeps;
      if (convergence.reached(sweeps, rest.norm() / size)) return solution;
    }
  }

  SolverOptions options_;
  opencl::Session session_;
  opencl::Kernel kernel_;
  opencl::Buffer x_, r_, row_, start_, column_, value_, reciprocal_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_gauss_seidel(const SolverOptions& options) {
  return std::make_unique<GaussSeidel>(options);
}

}  // namespace curveskel
