// Laws of the Cholesky factor, over Laplacians with areas on their diagonal.
#include "contraction/solvers/cholesky_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/error.hpp>
#include "contraction/solvers/elimination_tree.hpp"
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

/// Patterns on which a search has little to go by: apart, a star, all joined to all, a path, one,
/// none.
std::vector<SparseMatrix> odd_patterns() {
  std::vector<SparseMatrix> matrices;
  const auto add = [&](int count, const auto& joined) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < count; ++i) {
      entries.emplace_back(i, i, count + 1);
      for (int j = 0; j < i; ++j) {
        if (!joined(i, j)) continue;
        entries.emplace_back(i, j, -1);
        entries.emplace_back(j, i, -1);
      }
    }
    matrices.emplace_back(count, count);
    matrices.back().setFromTriplets(entries.begin(), entries.end());
  };
  const auto never = [](int, int) { return false; };
  add(300, never);
  add(300, [](int, int j) { return j == 0; });
  add(90, [](int, int) { return true; });
  add(300, [](int i, int j) { return i == j + 1; });
  add(400, [](int i, int j) { return i % 7 == j % 7 && i < j + 40; });  // seven bands
  add(1, never);
  add(0, never);
  return matrices;
}

TEST(CholeskyFactor, SolvesWhateverThePattern) {
  CholeskyFactor factor(2);
  CholeskyFactor::Workspace workspace;
  for (const SparseMatrix& h : odd_patterns()) {
    factor.factorize(h);
    const Eigen::MatrixXd r = random_columns(h.rows(), 2, 9);
    const Eigen::MatrixXd x = factor.solve(r, workspace);
    EXPECT_LE((h * x - r).norm(), 1e-12 * r.norm());
  }
}

TEST(CholeskyFactor, IsTheSameFromAnyNumberOfThreads) {
  std::vector<SparseMatrix> matrices = definite_matrices();
  matrices.push_back(laplacian_and_areas(shapes::torus(3, 1, 90).surface, 1));
  for (const SparseMatrix& h : matrices) {
    const Eigen::MatrixXd r = random_columns(h.rows(), 3, 10);
    CholeskyFactor::Workspace workspace;
    CholeskyFactor alone(1);
    alone.factorize(h);
    const Eigen::MatrixXd wanted = alone.solve(r, workspace);
    for (const int threads : {2, 5}) {
      CholeskyFactor factor(threads);
      factor.factorize(h);
      const Eigen::MatrixXd x = factor.solve(r, workspace);
      EXPECT_EQ(std::memcmp(x.data(), wanted.data(), idx(x.size()) * sizeof(double)), 0);
    }
  }
}

/// Each unknown has one place, and what joins two of them lies on one way to the root.
TEST(EliminationTree, SeparatesWhatItCallsApart) {
  std::vector<SparseMatrix> matrices = odd_patterns();
  for (const SparseMatrix& h : definite_matrices()) matrices.push_back(h);
  for (const SparseMatrix& h : matrices) {
    const EliminationTree tree = dissect(h, 2);
    std::vector<int> node_at(idx(h.rows()), -1);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      for (int place = tree.nodes[i].pivots; place < tree.nodes[i].end; ++place) {
        EXPECT_EQ(node_at[idx(place)], -1);
        node_at[idx(place)] = static_cast<int>(i);
      }
    }
    for (int v = 0; v < h.cols(); ++v) {
      ASSERT_EQ(tree.unknown_at[idx(tree.place_of[idx(v)])], v);
      ASSERT_GE(node_at[idx(tree.place_of[idx(v)])], 0);
      for (SparseMatrix::InnerIterator entry(h, v); entry; ++entry) {
        const int low = std::min(tree.place_of[idx(v)], tree.place_of[idx(entry.row())]);
        const int high = std::max(tree.place_of[idx(v)], tree.place_of[idx(entry.row())]);
        const EliminationNode& above = tree.nodes[idx(node_at[idx(high)])];
        EXPECT_GE(low, above.first);
        const std::vector<int>& border = tree.nodes[idx(node_at[idx(low)])].border;
        EXPECT_TRUE(node_at[idx(low)] == node_at[idx(high)] ||
                    std::binary_search(border.begin(), border.end(), high));
      }
    }
  }
}

double factor_entries(const SparseMatrix& h) {
  double entries = 0;
  for (const EliminationNode& node : dissect(h, 1).nodes) {
    entries += node.pivot_count() * (0.5 * node.pivot_count() + node.border_count());
  }
  return entries;
}

/// The two ends of a cone are one fan each: hubs that all sides are joined to.
TEST(EliminationTree, HubsFillNothing) {
  for (const int sides : {1000, 4000}) {
    const SparseMatrix h = laplacian_and_areas(shapes::cone(1, 2, sides).surface, 1);
    EXPECT_LT(factor_entries(h), 60 * static_cast<double>(h.rows())) << sides;
  }
}

TEST(CholeskyFactor, StopsWhenAskedAndIsAsGoodAsNew) {
  std::stop_source source;
  CholeskyFactor factor(2);
  CholeskyFactor::Workspace workspace;
  for (const SparseMatrix& h : definite_matrices()) {
    const Eigen::MatrixXd r = random_columns(h.rows(), 2, 9);
    factor.factorize(h, source.get_token());
    const Eigen::MatrixXd wanted = factor.solve(r, workspace);
    std::stop_source stopped;
    stopped.request_stop();
    EXPECT_THROW(factor.factorize(h, stopped.get_token()), Cancelled);
    factor.factorize(h, source.get_token());
    EXPECT_EQ(Eigen::MatrixXd(factor.solve(r, workspace)), wanted);
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
