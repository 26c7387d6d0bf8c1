#include "contraction/solvers/study/spectrum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace curveskel {
namespace {

/// Some vector that is in no subspace of interest.
Eigen::VectorXd scattered_vector(Eigen::Index size) {
  Eigen::VectorXd result(size);
  std::uint64_t state = 1;
  for (double& value : result) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    value = static_cast<double>(state >> 11U) * 0x1p-53 - 0.5;
  }
  return result.normalized();
}

}  // namespace

double Spectrum::jacobi_radius() const { return std::max(largest - 1, 1 - least); }
double Spectrum::jor_radius() const { return (largest - least) / (largest + least); }

// C. Lanczos 1950, without reorthogonalisation: what rounding brings back are copies of extreme
// eigenvalues, which do no harm here.
Spectrum jacobi_spectrum(const SparseMatrix& h, int steps, const Monitor& monitor) {
  const Eigen::VectorXd scale = h.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::VectorXd now = scattered_vector(h.cols());
  Eigen::VectorXd before = Eigen::VectorXd::Zero(h.cols());
  std::vector<double> diagonal;
  std::vector<double> beside;
  const int most = static_cast<int>(std::min<Eigen::Index>(steps, h.cols()));
  for (int step = 0; step < most; ++step) {
    throw_if_stopped(monitor.stop);
    Eigen::VectorXd next = scale.asDiagonal() * (h * (scale.asDiagonal() * now).eval());
    if (!beside.empty()) next -= beside.back() * before;
    diagonal.push_back(now.dot(next));
    next -= diagonal.back() * now;
    const double size = next.norm();
    if (!(size > 1e-12)) break;
    beside.push_back(size);
    before.swap(now);
    now = next / size;
  }
  const auto count = static_cast<Eigen::Index>(diagonal.size());
  if (count == 0) return {};
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), count),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), count - 1),
                                Eigen::EigenvaluesOnly);
  // Contraction leaves constant vectors nearly alone, which Lanczos would find last of all.
  const double constant = (h * Eigen::VectorXd::Ones(h.cols())).sum() / h.diagonal().sum();
  return {std::min(constant, solver.eigenvalues().minCoeff()),
          std::max(constant, solver.eigenvalues().maxCoeff())};
}

double iterations_for(double factor, double radius) {
  if (!(radius < 1)) return std::numeric_limits<double>::infinity();
  if (radius <= 0) return 1;
  return std::ceil(std::log(factor) / std::log(radius));
}

}  // namespace curveskel
