#include "contraction/flow/flow_system.hpp"

#include <algorithm>
#include <cmath>

namespace curveskel {
namespace {

constexpr double flow_mollify = 1e-4;
constexpr double max_edge_weight = 1e3;
constexpr double max_contraction_weight = 1e5;  // w_L and W_L stop growing here
constexpr double max_area_loss = 1e14;          // cap of A0 / A

/// [first L; diag(second)], n + n rows.
SparseMatrix stacked(double first, const SparseMatrix& laplacian, const Eigen::VectorXd& second) {
  const Eigen::Index n = laplacian.cols();
  SparseMatrix a(2 * n, n);
  a.resizeNonZeros(laplacian.nonZeros() + n);
  int filled = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    a.outerIndexPtr()[j] = filled;
    for (SparseMatrix::InnerIterator entry(laplacian, j); entry; ++entry) {
      a.innerIndexPtr()[filled] = static_cast<int>(entry.row());
      a.valuePtr()[filled++] = first * entry.value();
    }
    a.innerIndexPtr()[filled] = static_cast<int>(n + j);
    a.valuePtr()[filled++] = second[j];
  }
  a.outerIndexPtr()[n] = filled;
  return a;
}

SolverOptions solver_options(const ContractionOptions& options) {
  SolverOptions result;
  result.solver = options.solver;
  result.program_cache = options.program_cache;
  result.threads = options.threads;
  return result;
}

}  // namespace

FlowSystem::FlowSystem(const ContractionOptions& options, double mean_face_area)
    : options_(options),
      weight_(options.flow == Flow::medial ? options.contraction_weight
                                           : options.paper_weight * std::sqrt(mean_face_area)),
      pull_(options.medial_weight * options.medial_weight),
      solver_(solver_options(options)) {}

Solution FlowSystem::solve(const ContractingSurface& surface, const Monitor& monitor) {
  assembly_.assemble(
      triangulation_.weights(surface.mesh, surface.positions, flow_mollify, max_edge_weight),
      surface.mesh.vertices(), laplacian_);
  // 1 where there was no area to lose.
  const Eigen::ArrayXd initial = surface.initial_areas.array();
  const Eigen::ArrayXd present = surface.vertex_areas().array().max(initial / max_area_loss);
  const Eigen::VectorXd loss = (initial > 0).select(initial / present, 1);
  switch (options_.flow) {
    case Flow::medial:
      return solve_medial(surface, loss, monitor);
    case Flow::paper:
      return solve_paper(surface, loss, monitor);
  }
  return {};
}

/// (diag(A0/A + W_M^2) - w_L L) X' = (A0/A) X + W_M^2 C.
Solution FlowSystem::solve_medial(const ContractingSurface& surface, const Eigen::VectorXd& loss,
                                  const Monitor& monitor) {
  laplacian_ *= -weight_;
  laplacian_.diagonal() += (loss.array() + pull_).matrix();
  const Positions right = loss.asDiagonal() * surface.positions + pull_ * surface.centres;
  return solver_.solve_definite(laplacian_, right, monitor);
}

/// min ||W_L L X'||^2 + ||W_H (X' - X)||^2 with W_H = W_H0 sqrt(A0/A): eq. 3 of the paper.
Solution FlowSystem::solve_paper(const ContractingSurface& surface, const Eigen::VectorXd& loss,
                                 const Monitor& monitor) {
  const Eigen::VectorXd attraction = options_.attraction_weight * loss.cwiseSqrt();
  const Eigen::Index n = attraction.size();
  Positions right = Positions::Zero(2 * n, 3);
  right.bottomRows(n) = attraction.asDiagonal() * surface.positions;
  return solver_.solve(stacked(weight_, laplacian_, attraction), right, monitor);
}

void FlowSystem::accepted() {
  grow();
  pull_ = std::min(4 * pull_, options_.medial_weight * options_.medial_weight);
}

void FlowSystem::rejected() {
  grow();
  pull_ /= 4;
}

void FlowSystem::grow() {
  const double limit = std::max(weight_, max_contraction_weight);
  weight_ = std::min(weight_ * options_.contraction_growth, limit);
}

}  // namespace curveskel
