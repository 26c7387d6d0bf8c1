// Laws of the Cholesky factor, over Laplacians with areas on their diagonal.
#include "contraction/solvers/cholesky_factor.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <future>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::cholesky_factor_laws {
namespace {

/// -L + A / `spread`, positive definite.
SparseMatrix laplacian_and_areas(const Surface& surface, double spread) {
  SparseMatrix h = -intrinsic_delaunay_laplacian(surface);
  h.diagonal() += vertex_areas(surface) / spread;
  return h;
}

std::vector<SparseMatrix> definite_matrices() {
  const Surface y = shapes::tube_union("", shapes::star(3, 6, 1)).surface;
  const Surface ring = shapes::torus(3, 1, 20).surface;
  return {laplacian_and_areas(y, 1), laplacian_and_areas(ring, 0.1), laplacian_and_areas(ring, 10)};
}

Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::MatrixXd result(rows, columns);
  for (double& entry : result.reshaped()) entry = unit(random);
  return result;
}

TEST(CholeskyFactor, SolvesForAnyNumberOfColumns) {
  CholeskyFactor factor;
  CholeskyFactor::Workspace workspace;  // one for all: its memory grows and shrinks
  for (const SparseMatrix& h : definite_matrices()) {
    factor.factorize(h);
    for (const Eigen::Index columns : {1, 17, 3}) {
      const Eigen::MatrixXd r = random_columns(h.rows(), columns, 5);
      const Eigen::MatrixXd x = factor.solve(r, workspace);
      ASSERT_EQ(x.rows(), h.rows());
      ASSERT_EQ(x.cols(), columns);
      for (Eigen::Index column = 0; column < columns; ++column) {
        const Eigen::VectorXd left = h * x.col(column);
        EXPECT_LT((left - r.col(column)).norm(), 1e-10 * r.col(column).norm());
      }
    }
  }
}

TEST(CholeskyFactor, SolvesColumnsAsItSolvesThemAlone) {
  CholeskyFactor factor;
  CholeskyFactor::Workspace workspace;
  for (const SparseMatrix& h : definite_matrices()) {
    factor.factorize(h);
    const Eigen::MatrixXd r = random_columns(h.rows(), 17, 6);
    const Eigen::MatrixXd all = factor.solve(r, workspace);
    for (Eigen::Index column = 0; column < r.cols(); ++column) {
      const Eigen::MatrixXd alone = factor.solve(r.col(column), workspace);
      EXPECT_LT((alone - all.col(column)).norm(), 1e-12 * alone.norm());
    }
  }
}

/// Nothing of the first matrix is left after a second of the same pattern, or of another.
TEST(CholeskyFactor, ForgetsTheMatrixBefore) {
  const std::vector<SparseMatrix> matrices = definite_matrices();
  CholeskyFactor reused;
  CholeskyFactor::Workspace workspace;
  for (const std::size_t k : {1, 2, 0, 2}) {
    const SparseMatrix& h = matrices[k];
    const Eigen::MatrixXd r = random_columns(h.rows(), 2, k);
    reused.factorize(h);
    CholeskyFactor fresh;
    fresh.factorize(h);
    CholeskyFactor::Workspace own;
    EXPECT_EQ(Eigen::MatrixXd(reused.solve(r, workspace)), Eigen::MatrixXd(fresh.solve(r, own)));
  }
}

TEST(CholeskyFactor, GivesEachOfTwoThreadsTheSameBytes) {
  const SparseMatrix h = definite_matrices().front();
  CholeskyFactor factor;
  factor.factorize(h);
  const Eigen::MatrixXd r = random_columns(h.rows(), 8, 7);
  const auto solve_often = [&] {
    std::vector<Eigen::MatrixXd> found(20);
    CholeskyFactor::Workspace workspace;
    for (Eigen::MatrixXd& x : found) x = factor.solve(r, workspace);
    return found;
  };
  std::future<std::vector<Eigen::MatrixXd>> beside = std::async(std::launch::async, solve_often);
  const std::vector<Eigen::MatrixXd> here = solve_often();
  const std::vector<Eigen::MatrixXd> there = beside.get();
  for (const auto* found : {&here, &there}) {
    for (const Eigen::MatrixXd& x : *found) {
      EXPECT_EQ(std::memcmp(x.data(), here[0].data(), idx(x.size()) * sizeof(double)), 0);
    }
  }
}

TEST(CholeskyFactor, RefusesWhatIsNotPositiveDefinite) {
  CholeskyFactor factor;
  for (const SparseMatrix& h : definite_matrices()) {
    SparseMatrix indefinite = h;
    indefinite.coeffRef(h.rows() / 2, h.rows() / 2) = -1;
    try {
      factor.factorize(indefinite);
      ADD_FAILURE() << "factorised";
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::solver);
      EXPECT_NE(std::string(error.what()).find("not positive definite"), std::string::npos);
    }
    factor.factorize(h);  // and is as good as new
    CholeskyFactor::Workspace workspace;
    const Eigen::MatrixXd r = random_columns(h.rows(), 1, 8);
    const Eigen::MatrixXd x = factor.solve(r, workspace);
    EXPECT_LT((h * x - r).norm(), 1e-10 * r.norm());
  }
}

}  // namespace
}  // namespace curveskel::cholesky_factor_laws
