#include "contraction/fairing/patch_solution.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <cmath>
#include <complex>
#include <vector>

#include "contraction/fairing/least_height.hpp"

namespace curveskel {
namespace {

constexpr std::size_t largest_patch_for_qr = 256;

/// Positions relative to the centre, which lose no digits far from the origin.
Positions relative_to_centre(const Patch& patch, const Positions& positions) {
  Positions relative(static_cast<Eigen::Index>(patch.vertices.size()), 3);
  for (Eigen::Index i = 0; i < relative.rows(); ++i) {
    relative.row(i) = positions.row(patch.vertices[static_cast<std::size_t>(i)]) -
                      positions.row(patch.vertices[0]);
  }
  return relative;
}

/// Calls add(i, j, w) for every edge of every triangle, w = mu / 2 times the cotangent opposite;
/// nothing for a face without area.
template <typename Add>
void for_each_patch_weight(const Patch& patch, const Positions& relative, double smoothing,
                           Add add) {
  for (const auto& [a, b, c] : patch.triangles) {
    const Eigen::RowVector3d first = relative.row(b) - relative.row(a);
    const Eigen::RowVector3d second = relative.row(c) - relative.row(a);
    const Eigen::RowVector3d edge = second - first;
    const SideProducts of{first.dot(second), first.dot(edge), second.dot(edge)};
    const double square = first.cross(second).squaredNorm();
    if (!has_area(square, of)) continue;
    const double scale = 0.5 * smoothing / std::sqrt(square);
    add(b, c, scale * of.first_second);
    add(c, a, -scale * of.first_edge);
    add(a, b, scale * of.second_edge);
  }
}

/// mu L with rows and columns numbered by `number`.
template <typename Number>
void add_laplacian(const Patch& patch, const Positions& relative, double smoothing, Number number,
                   Eigen::Ref<Eigen::MatrixXd> matrix) {
  const auto add = [&](Eigen::Index a, Eigen::Index b, double weight) {
    const Eigen::Index i = number(a);
    const Eigen::Index j = number(b);
    matrix(i, j) += weight;
    matrix(j, i) += weight;
    matrix(i, i) -= weight;
    matrix(j, j) -= weight;
  };
  for_each_patch_weight(patch, relative, smoothing, add);
}

}  // namespace

Eigen::RowVector3d centre_step_by_full_qr(const Patch& patch, const Positions& positions,
                                          double smoothing) {
  const Positions relative = relative_to_centre(patch, positions);
  const Eigen::Index n = relative.rows();
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(2 * n, n);
  add_laplacian(
      patch, relative, smoothing, [](Eigen::Index i) { return i; }, stacked.topRows(n));
  stacked.bottomRows(n).setIdentity();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(2 * n, 3);
  right.bottomRows(n) = relative;
  return stacked.householderQr().solve(right).row(0);
}

// Eliminating column j of [mu L; I] touches the rows j.. of mu L and 0..j of I, n + 1 in all: row
// j + 1 of I takes the place of row j of mu L, which is done with. The centre is the last column,
// so that its value needs no back substitution and the triangular factor is not kept.
Eigen::RowVector3d centre_step_by_qr(const Patch& patch, const Positions& positions,
                                     double smoothing) {
  const Positions relative = relative_to_centre(patch, positions);
  const Eigen::Index n = relative.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 3);
  const auto column_of = [n](Eigen::Index i) { return i == 0 ? n - 1 : i - 1; };
  add_laplacian(patch, relative, smoothing, column_of, system.topLeftCorner(n, n));
  const auto enter = [&](Eigen::Index row, Eigen::Index column) {
    system.row(row).tail(n + 3 - column).setZero();
    system(row, column) = 1;
    system.row(row).tail<3>() = relative.row(column + 1 == n ? 0 : column + 1);
  };
  enter(n, 0);
  Eigen::VectorXd reflector(n + 1);
  for (Eigen::Index j = 0;; ++j) {
    const double norm = system.col(j).norm();  // >= 1, as the identity is below
    const double pivot = system(j, j);
    const double diagonal = pivot > 0 ? -norm : norm;
    reflector = system.col(j) / norm;
    reflector(j) -= diagonal / norm;
    const double factor = 1 / (1 + std::abs(pivot) / norm);
    for (Eigen::Index k = j + 1; k < n + 3; ++k) {
      const double product = factor * reflector.dot(system.col(k));
      system.col(k) -= product * reflector;
    }
    if (j == n - 1) return system.row(j).tail<3>() / diagonal;
    enter(j, j + 1);
  }
}

Eigen::RowVector3d centre_step_by_lu(const Patch& patch, const Positions& positions,
                                     double smoothing) {
  using Complex = std::complex<double>;
  const Positions relative = relative_to_centre(patch, positions);
  const Eigen::Index n = relative.rows();
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(n) + 12 * patch.triangles.size());
  for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(i, i, 1);
  const auto add = [&](Eigen::Index i, Eigen::Index j, double weight) {
    const Complex entry(0, weight);
    entries.emplace_back(i, j, entry);
    entries.emplace_back(j, i, entry);
    entries.emplace_back(i, i, -entry);
    entries.emplace_back(j, j, -entry);
  };
  for_each_patch_weight(patch, relative, smoothing, add);
  Eigen::SparseMatrix<Complex> system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu(system);
  const Eigen::Matrix<Complex, Eigen::Dynamic, 3> right = relative.cast<Complex>();
  const Eigen::Matrix<Complex, Eigen::Dynamic, 3> solution = lu.solve(right);
  return solution.row(0).real();
}

Eigen::RowVector3d centre_step(const Patch& patch, const Positions& positions, double smoothing) {
  return patch.vertices.size() <= largest_patch_for_qr
             ? centre_step_by_qr(patch, positions, smoothing)
             : centre_step_by_lu(patch, positions, smoothing);
}

}  // namespace curveskel
