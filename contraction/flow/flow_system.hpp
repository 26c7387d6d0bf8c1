// The linear system of one contraction iteration.
#pragma once

#include <Eigen/Core>

#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/contract.hpp>
#include "contraction/flow/contracting_surface.hpp"
#include "contraction/laplacian/assemble.hpp"
#include "contraction/laplacian/intrinsic_delaunay.hpp"

namespace curveskel {

/// The wanted positions of a flow. Holds the weights as they change from one iteration to
/// the next and the memory that the iterations share.
class FlowSystem {
 public:
  /// `mean_face_area` of the surface at the start, for the paper's W_L.
  FlowSystem(const ContractionOptions& options, double mean_face_area);

  [[nodiscard]] Solution solve(const ContractingSurface& surface, const Monitor& monitor);

  /// Adapts the weights for the next iteration: more contraction, and after a rejected one less
  /// pull, because wrong centres make a surface grow.
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
