// The paper's global flow with nothing added: fixed connectivity, no step control, no collapses.
#pragma once

#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/surface.hpp>

namespace curveskel::bench {

/// A torus of `around` x `across` vertices whose thickness and height vary: closed, genus 1, any
/// number of vertices that factors.
[[nodiscard]] Surface wavy_ring(int around, int across);

/// One of the sizes of the paper's table: 648, 1416, 5664 or 14952 vertices.
[[nodiscard]] Surface surface_of_table(int vertices);

class PaperFlow {
 public:
  /// `weight`: W_L of the first iteration over the square root of the mean face area; it doubles
  /// with each iteration.
  PaperFlow(Surface surface, double weight);

  struct System {
    SparseMatrix a;  ///< [W_L L; W_H], 2 n x n
    Positions b;     ///< [0; W_H V], 2 n x 3
  };
  /// Equation 3 for the positions as they are.
  [[nodiscard]] System system() const;
  void accept(const Positions& next);

  [[nodiscard]] double volume_ratio() const;
  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  Surface surface_;
  Eigen::VectorXd initial_areas_;
  double initial_volume_;
  double weight_;
};

}  // namespace curveskel::bench
