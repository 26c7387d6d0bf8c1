// The linear system of one contraction iteration.
#pragma once

#include <Eigen/Core>

#include "contraction/assemble.hpp"
#include "contraction/contract.hpp"
#include "contraction/contracting_surface.hpp"
#include "contraction/intrinsic_delaunay.hpp"
#include "contraction/least_squares.hpp"

namespace curveskel {

/// Where a flow wants the vertices to be. Holds the weights as they change from one iteration to
/// the next and the memory that the iterations share.
class FlowSystem {
 public:
  /// `mean_face_area` of the surface at the start, for the paper's W_L.
  FlowSystem(const ContractionOptions& options, double mean_face_area);

  [[nodiscard]] Solution solve(const ContractingSurface& surface, const Monitor& monitor);

  /// Adapts the weights for the next iteration: more contraction, and after a rejected one less
  /// pull, because wrong centres are what makes a surface grow.
  void accepted();
  void rejected();

  [[nodiscard]] Solver solver() const { return solver_.solver(); }

 private:
  [[nodiscard]] Solution solve_medial(const ContractingSurface& surface,
                                      const Eigen::VectorXd& loss, const Monitor& monitor);
  [[nodiscard]] Solution solve_paper(const ContractingSurface& surface, const Eigen::VectorXd& loss,
                                     const Monitor& monitor);
  void grow();

  const ContractionOptions& options_;
  double weight_;  // w_L (medial) or W_L (paper)
  double pull_;    // W_M^2
  IntrinsicDelaunay triangulation_;
  LaplacianAssembly assembly_;
  SparseMatrix laplacian_;
  LeastSquares solver_;
};

}  // namespace curveskel
