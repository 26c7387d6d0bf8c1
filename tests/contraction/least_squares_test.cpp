// Laws that every back end obeys: one answer for one problem, an honest residual, no wrong answer.
#include <curveskel/advanced/least_squares.hpp>

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/device.hpp>
#include <curveskel/error.hpp>
#include "contraction/solvers/study/householder_panel.hpp"
#include "contraction/solvers/study/spectrum.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::least_squares_laws {
namespace {

struct System {
  std::string name;
  SparseMatrix a;
  Positions b;
};

/// [W_L L; W_H] X = [0; W_H X0] (eq. 3) on a small surface.
System stacked(const std::string& name, const Surface& surface, double contraction) {
  const SparseMatrix l = intrinsic_delaunay_laplacian(surface);
  const Eigen::Index n = l.cols();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator entry(l, j); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(j),
                           contraction * entry.value());
    }
    entries.emplace_back(static_cast<int>(n + j), static_cast<int>(j),
                         1 + 0.5 * std::sin(static_cast<double>(j)));
  }
  System system{name, SparseMatrix(2 * n, n), Positions::Zero(2 * n, 3)};
  system.a.setFromTriplets(entries.begin(), entries.end());
  system.b.bottomRows(n) = surface.positions;
  return system;
}

const std::vector<System>& systems() {
  static const std::vector<System> all = [] {
    const Surface sphere = shapes::ellipsoid({1, 1, 1}, 2).surface;
    const Surface ring = shapes::torus(3, 1, 12).surface;
    std::vector<System> made = {
        stacked("sphere, weak contraction", sphere, 0.1),
        stacked("sphere, strong contraction", sphere, 100),
        stacked("ring", ring, 10),
    };
    System polynomial{"a cubic through seven values", SparseMatrix(7, 4), Positions(7, 3)};
    for (int i = 0; i < 7; ++i) {
      for (int k = 0; k < 4; ++k) polynomial.a.insert(i, k) = std::pow(0.3 * i - 1, k);
      polynomial.b.row(i) << std::sin(i), std::cos(i), i;
    }
    polynomial.a.makeCompressed();
    made.push_back(polynomial);
    System square{"one unknown, one row", SparseMatrix(1, 1), Positions(1, 3)};
    square.a.insert(0, 0) = 4;
    square.b << 4, 8, 12;
    made.push_back(square);
    return made;
  }();
  return all;
}

SparseMatrix normal_matrix(const System& system) { return system.a.transpose() * system.a; }

bool has_device() {
  const auto all = devices();
  return std::any_of(all.begin(), all.end(), [](const Device& d) { return d.double_precision; });
}

std::string test_name(const testing::TestParamInfo<Solver>& each) {
  std::string name(name_of(solvers, each.param));
  std::erase(name, '-');
  return name;
}

class SolverTest : public testing::TestWithParam<Solver> {
 protected:
  void SetUp() override {
    if (needs_device(GetParam()) && !has_device()) {
      GTEST_SKIP() << "no OpenCL device with double precision on this machine";
    }
  }
};

/// The direct ones.
class EverySolver : public SolverTest {};

TEST_P(EverySolver, AgreesWithDenseQr) {
  LeastSquares solver(GetParam());
  for (const auto& system : systems()) {
    const Eigen::MatrixXd expected =
        Eigen::MatrixXd(system.a).colPivHouseholderQr().solve(Eigen::MatrixXd(system.b));
    const Solution solution = solver.solve(system.a, system.b);
    EXPECT_LE((solution.x - expected).norm(), 1e-8 * expected.norm()) << system.name;
    EXPECT_LE(solution.residual, 1e-10) << system.name;
  }
}

TEST_P(EverySolver, SolvesDefiniteSystems) {
  LeastSquares solver(GetParam());
  for (const auto& system : systems()) {
    const SparseMatrix h = normal_matrix(system);
    const Positions known = Eigen::RowVector3d(1, -2, 3).replicate(h.rows(), 1);
    const Positions right = h * known;
    const Solution solution = solver.solve_definite(h, right);
    EXPECT_LE((solution.x - known).norm(), 1e-7 * known.norm()) << system.name;
    // Backward stable: as small a residual as rounding H X allows.
    const double rounding = 1e-14 * h.norm() * solution.x.norm() / right.norm();
    EXPECT_LE(solution.residual, rounding) << system.name;
  }
}

TEST_P(EverySolver, GivesTheSameBytesWhetherThePatternIsKnownOrNew) {
  const System first = stacked("", shapes::torus(3, 1, 12).surface, 10);
  System second = first;
  second.a *= 0.5;
  LeastSquares reused(GetParam());
  (void)reused.solve(first.a, first.b);
  const Positions again = reused.solve(second.a, second.b).x;
  const Positions fresh = LeastSquares(GetParam()).solve(second.a, second.b).x;
  EXPECT_EQ(again, fresh);
}

TEST_P(EverySolver, TakesASystemOfAnotherSizeNext) {
  LeastSquares solver(GetParam());
  for (int round = 0; round < 2; ++round) {
    for (const auto& system : systems()) {
      EXPECT_LE(solver.solve(system.a, system.b).residual, 1e-10) << system.name;
    }
  }
}

TEST_P(EverySolver, ReportsTheResidualOfWhatItReturns) {
  LeastSquares solver(GetParam());
  for (const auto& system : systems()) {
    const Solution solution = solver.solve(system.a, system.b);
    const Positions misfit = system.a * solution.x - system.b;
    const Positions gradient = system.a.transpose() * misfit;
    const Positions right = system.a.transpose() * system.b;
    EXPECT_DOUBLE_EQ(solution.residual, gradient.norm() / right.norm()) << system.name;
  }
}

/// The error thrown has the solver's fault and says something about the matrix.
template <typename Solve>
void expect_solver_error(const Solve& solve, const std::string& said) {
  try {
    solve();
    FAIL() << "no error: " << said;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::solver);
    EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
  }
}

SparseMatrix without_full_rank() {
  SparseMatrix a(6, 3);
  for (int i = 0; i < 6; ++i) {
    a.insert(i, 0) = 1 + i;
    a.insert(i, 1) = 1;
  }  // the third column is empty
  a.makeCompressed();
  return a;
}

TEST_P(EverySolver, RefusesAMatrixWithoutFullRank) {
  const SparseMatrix a = without_full_rank();
  LeastSquares solver(GetParam());
  expect_solver_error([&] { (void)solver.solve(a, Positions::Ones(6, 3)); }, "3");
  // The solver is still of use afterwards.
  EXPECT_LE(solver.solve(systems()[0].a, systems()[0].b).residual, 1e-10);
}

TEST_P(EverySolver, StopsWhenAsked) {
  const System& system = systems()[1];
  const SparseMatrix h = normal_matrix(system);
  std::stop_source source;
  Monitor monitor;
  monitor.stop = source.get_token();
  LeastSquares solver(GetParam());
  const Solution before = solver.solve(system.a, system.b, monitor);
  source.request_stop();
  EXPECT_THROW((void)solver.solve(system.a, system.b, monitor), Cancelled);
  EXPECT_THROW((void)solver.solve_definite(h, system.b.topRows(h.rows()), monitor), Cancelled);
  EXPECT_EQ(solver.solve(system.a, system.b).x, before.x);  // of use afterwards
}

TEST_P(EverySolver, RefusesShapesThatDoNotFit) {
  const System& system = systems()[0];
  LeastSquares solver(GetParam());
  const SparseMatrix wide = system.a.transpose();
  expect_solver_error([&] { (void)solver.solve(wide, Positions::Ones(wide.rows(), 3)); },
                      "at least as many rows");
  expect_solver_error([&] { (void)solver.solve(system.a, Positions::Ones(3, 3)); }, "right-hand");
  expect_solver_error([&] { (void)solver.solve_definite(system.a, system.b); }, "square");
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, EverySolver,
                         testing::Values(Solver::automatic, Solver::cholesky, Solver::sparse_qr,
                                         Solver::dense_qr, Solver::vcl_qr, Solver::vcl_lsm),
                         test_name);

/// Those that may not get there, and must say so.
class EveryIteration : public SolverTest {};

TEST_P(EveryIteration, IsRightOrSaysWhyNot) {
  int solved = 0;
  LeastSquares solver(GetParam());
  for (const auto& system : systems()) {
    const Eigen::MatrixXd expected =
        Eigen::MatrixXd(system.a).colPivHouseholderQr().solve(Eigen::MatrixXd(system.b));
    try {
      const Solution solution = solver.solve(system.a, system.b);
      EXPECT_LE(solution.residual, 2e-10) << system.name;
      EXPECT_LE((solution.x - expected).norm(), 1e-4 * expected.norm()) << system.name;
      EXPECT_GT(solution.iterations, 0) << system.name;
      ++solved;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::solver) << system.name;
      EXPECT_NE(std::string(error.what()).find("use the solver cholesky"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_GT(solved, 0);
}

TEST_P(EveryIteration, ConvergesWhereHardlyAnythingContracts) {
  const System weak = stacked("weak", shapes::torus(3, 1, 12).surface, 0.05);
  const Eigen::MatrixXd expected =
      Eigen::MatrixXd(weak.a).colPivHouseholderQr().solve(Eigen::MatrixXd(weak.b));
  LeastSquares solver(GetParam());
  const Solution solution = solver.solve(weak.a, weak.b);
  EXPECT_LE((solution.x - expected).norm(), 1e-8 * expected.norm());
  const SparseMatrix h = normal_matrix(weak);
  const Positions right = weak.a.transpose() * weak.b;
  EXPECT_LE((solver.solve_definite(h, right).x - expected).norm(), 1e-8 * expected.norm());
}

TEST_P(EveryIteration, GivesTheSameBytesAgain) {
  const System weak = stacked("weak", shapes::torus(3, 1, 12).surface, 0.05);
  const Solution once = LeastSquares(GetParam()).solve(weak.a, weak.b);
  const Solution again = LeastSquares(GetParam()).solve(weak.a, weak.b);
  EXPECT_EQ(once.x, again.x);
  EXPECT_EQ(once.iterations, again.iterations);
}

TEST_P(EveryIteration, GivesUpAtItsLimitAndStopsWhenAsked) {
  const System system = stacked("some", shapes::torus(3, 1, 12).surface, 0.05);
  SolverOptions options;
  options.solver = GetParam();
  options.most_iterations = 3;
  options.tolerance = 1e-15;
  expect_solver_error([&] { (void)LeastSquares(options).solve(system.a, system.b); }, "iterations");
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)LeastSquares(GetParam()).solve(system.a, system.b, monitor), Cancelled);
}

TEST_P(EveryIteration, RefusesAMatrixWithoutFullRank) {
  const SparseMatrix a = without_full_rank();
  expect_solver_error([&] { (void)LeastSquares(GetParam()).solve(a, Positions::Ones(6, 3)); },
                      "not positive definite");
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, EveryIteration,
                         testing::Values(Solver::cg, Solver::gauss_seidel, Solver::jor,
                                         Solver::jacobi),
                         test_name);

/// The matrices of the first-order flow are strictly diagonally dominant.
TEST(Jacobi, ConvergesInTheFirstOrderFlow) {
  const Surface ring = shapes::torus(3, 1, 12).surface;
  for (const double contraction : {3.0, 1000.0}) {
    SparseMatrix h = -contraction * intrinsic_delaunay_laplacian(ring);
    h.diagonal().array() += 2;
    const Solution solution = LeastSquares(Solver::jacobi).solve_definite(h, ring.positions);
    EXPECT_LE(solution.residual, 1e-10) << contraction;
  }
}

TEST(Jacobi, DivergesWhereSomethingContractsAndSaysSo) {
  for (const double contraction : {10.0, 100.0, 1000.0}) {
    const System strong = stacked("strong", shapes::torus(3, 1, 12).surface, contraction);
    expect_solver_error([&] { (void)LeastSquares(Solver::jacobi).solve(strong.a, strong.b); },
                        "diverges: the spectral radius");
  }
}

TEST(Jor, TellsThatMillionsOfIterationsWouldBeNeeded) {
  const System strong = stacked("strong", shapes::torus(3, 1, 12).surface, 1e4);
  expect_solver_error([&] { (void)LeastSquares(Solver::jor).solve(strong.a, strong.b); },
                      "million iterations are needed");
}

TEST(ConjugateGradients, SolveWhatContractsStrongly) {
  if (!has_device()) GTEST_SKIP() << "no OpenCL device with double precision on this machine";
  for (const double contraction : {10.0, 1000.0}) {
    const System strong = stacked("strong", shapes::torus(3, 1, 12).surface, contraction);
    const Solution solution = LeastSquares(Solver::cg).solve(strong.a, strong.b);
    EXPECT_LE(solution.residual, 1e-10) << contraction;
  }
}

/// Eq. 3 on a surface whose attraction differs from vertex to vertex by `spread` at most, as where
/// parts of it have collapsed.
System unevenly_attracted(double contraction, double spread) {
  System system = stacked("uneven", shapes::torus(3, 1, 12).surface, contraction);
  const Eigen::Index n = system.a.cols();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double pull = std::pow(spread, 0.5 + 0.5 * std::sin(0.1 * static_cast<double>(j)));
    system.a.coeffRef(n + j, j) = pull;
    system.b.row(n + j) *= pull;
  }
  return system;
}

TEST(ConjugateGradients, NeedFewIterationsWhateverTheWeights) {
  if (!has_device()) GTEST_SKIP() << "no OpenCL device with double precision on this machine";
  for (const double contraction : {0.1, 10.0, 1000.0}) {
    for (const double spread : {1.0, 100.0, 1e4}) {
      const System system = unevenly_attracted(contraction, spread);
      const Solution solution = LeastSquares(Solver::cg).solve(system.a, system.b);
      EXPECT_LE(solution.residual, 2e-10) << contraction << ", " << spread;
      EXPECT_LE(solution.iterations, 40) << contraction << ", " << spread;
    }
  }
}

/// Of `rows` x `columns`, entries on and above the diagonal that `depth` rows below ends.
System filled_down_to(int rows, int columns, int depth) {
  System system{"filled", SparseMatrix(rows, columns), Positions(rows, 3)};
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows && i <= j + depth; ++i) {
      system.a.insert(i, j) = std::sin(1.0 + 7 * i + 13 * j + i * j) + (i == j ? 10 : 0);
    }
  }
  for (int i = 0; i < rows; ++i) system.b.row(i) << std::sin(i), std::cos(3 * i), 0.1 * i;
  system.a.makeCompressed();
  return system;
}

class EveryDeviceQr : public testing::TestWithParam<Solver> {
 protected:
  void SetUp() override {
    if (!has_device()) GTEST_SKIP() << "no OpenCL device with double precision on this machine";
  }
};

TEST_P(EveryDeviceQr, TakesAnyShapeAndLeavesOutZerosOnly) {
  LeastSquares solver(GetParam());
  for (const int columns : {1, 29, 31, 32, 33, 64, 95, 100}) {  // panels have 32
    for (const int more_rows : {0, 1, 32, columns + 5}) {
      for (const int depth : {0, 1, 40, 1000}) {
        const System system = filled_down_to(columns + more_rows, columns, depth);
        const Eigen::MatrixXd expected =
            Eigen::MatrixXd(system.a).colPivHouseholderQr().solve(Eigen::MatrixXd(system.b));
        const Positions found = solver.solve(system.a, system.b).x;
        EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm())
            << system.a.rows() << " x " << columns << ", depth " << depth;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, EveryDeviceQr,
                         testing::Values(Solver::vcl_qr, Solver::vcl_lsm), test_name);

TEST(HouseholderPanel, ReflectsWhatStandsBesideIt) {
  for (const int pivots : {0, 1, 5, 8}) {
    constexpr std::size_t rows = 20;
    constexpr std::size_t columns = 8;
    Eigen::MatrixXd panel = Eigen::MatrixXd::NullaryExpr(
        rows, columns, [](auto i, auto j) { return std::sin(1.0 + 3.0 * i + 7.0 * j * j); });
    panel.col(1) = panel.col(0);  // of no rank
    const Eigen::MatrixXd before = panel;
    Eigen::MatrixXd v(rows, columns);
    Eigen::MatrixXd w(columns, rows);
    eliminate({panel.data(), rows, columns, rows}, static_cast<std::size_t>(pivots),
              {v.data(), rows, columns, rows}, {w.data(), columns, rows, columns});
    const Eigen::MatrixXd reflection = Eigen::MatrixXd::Identity(rows, rows) - v * w;
    EXPECT_LE((reflection.transpose() * reflection - Eigen::MatrixXd::Identity(rows, rows)).norm(),
              1e-13);
    const Eigen::MatrixXd reflected = reflection * before;
    for (int j = 0; j < static_cast<int>(columns); ++j) {
      const int kept = j < pivots ? j + 1 : static_cast<int>(rows);
      EXPECT_LE((panel.col(j).head(kept) - reflected.col(j).head(kept)).norm(), 1e-13) << j;
      EXPECT_LE(reflected.col(j).tail(static_cast<int>(rows) - kept).norm(), 1e-13) << j;
    }
  }
}

TEST(JacobiSpectrum, IsThatOfADenseSolver) {
  for (const double contraction : {0.1, 10.0}) {
    const System system = stacked("", shapes::torus(3, 1, 12).surface, contraction);
    const SparseMatrix h = normal_matrix(system);
    const Eigen::VectorXd scale = h.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * Eigen::MatrixXd(h) * scale.asDiagonal();
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
            .eigenvalues();
    const Spectrum found = jacobi_spectrum(h, 60, {});
    EXPECT_LE(found.largest, values.maxCoeff() * (1 + 1e-12));
    EXPECT_GE(found.largest, values.maxCoeff() * 0.98);
    EXPECT_GE(found.least, values.minCoeff() * (1 - 1e-9));
  }
}

TEST(Cholesky, RefusesAMatrixThatIsNotDefinite) {
  SparseMatrix h(3, 3);
  h.insert(0, 0) = 1;
  h.insert(1, 1) = -1;
  h.insert(2, 2) = 1;
  h.makeCompressed();
  expect_solver_error(
      [&] { (void)LeastSquares(Solver::cholesky).solve_definite(h, Positions::Ones(3, 3)); },
      "not positive definite");
}

TEST(DenseSolvers, RefuseWhatDoesNotFitBeforeTheyAllocate) {
  SparseMatrix huge(400000, 400000);  // 1.3 TB
  huge.setIdentity();
  for (const Solver solver : {Solver::dense_qr, Solver::vcl_qr, Solver::vcl_lsm}) {
    expect_solver_error([&] { (void)LeastSquares(solver).solve(huge, Positions::Ones(400000, 3)); },
                        "use at most");
  }
}

TEST(ChooseSolver, IsCholeskyUnlessAnotherWasAskedFor) {
  for (const auto& entry : solvers) {
    const bool automatic = entry.value == Solver::automatic;
    EXPECT_EQ(choose_solver(entry.value), automatic ? Solver::cholesky : entry.value);
  }
}

TEST(LeastSquares, SaysWhichSolverItUsed) {
  LeastSquares solver(Solver::automatic);
  (void)solver.solve(systems()[0].a, systems()[0].b);
  EXPECT_EQ(solver.solver(), Solver::cholesky);
}

}  // namespace
}  // namespace curveskel::least_squares_laws
