// Non-negative cotangent weights: the intrinsic Delaunay triangulation of a mollified surface.
#pragma once

#include <vector>

#include <curveskel/surface.hpp>
#include "contraction/flow/collapsible_mesh.hpp"

namespace curveskel {

/// An edge i-j and its Laplacian weight (cot + cot) / 2. A pair of vertices may occur several
/// times, as intrinsic triangulations have parallel edges.
struct WeightedEdge {
  int i;
  int j;
  double weight;
};

/// Flips edges on lengths alone (Sharp and Crane 2020), so the surface itself stays as it is.
/// Keeps its arrays between calls.
class IntrinsicDelaunay {
 public:
  /// Edge weights, each in [0, max_weight], without the edges that flips have turned into loops.
  /// All lengths are first grown by the least epsilon that leaves each triangle a slack of
  /// `mollify` times the mean length. Precondition: `mesh` compact. O(#F) plus the flips.
  const std::vector<WeightedEdge>& weights(const CollapsibleMesh& mesh, const Positions& positions,
                                           double mollify, double max_weight);

 private:
  struct Half {
    double length;
    int from;
    int twin;  // -1 on a boundary
  };
  void set_lengths(const CollapsibleMesh& mesh, const Positions& positions, double mollify);
  void flip_to_delaunay();
  [[nodiscard]] bool is_delaunay(int h) const;
  void flip(int h);

  std::vector<Half> halves_;
  std::vector<double> double_area_;  // per face
  std::vector<int> stack_;
  std::vector<WeightedEdge> edges_;
};

}  // namespace curveskel
