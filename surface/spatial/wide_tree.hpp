// The hierarchy behind SurfaceTree: nodes of four boxes in single precision, leaves of four
// triangles in double precision, both laid out for four-wide arithmetic. Internal to surface/.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

using Float4 __attribute__((vector_size(16))) = float;
using Double2 __attribute__((vector_size(16))) = double;
using Double4 __attribute__((vector_size(32))) = double;
using Mask4 __attribute__((vector_size(32))) = long long;  ///< of a comparison: 0 or -1

/// Four children. A child >= 0 is a node, a child < 0 the leaf ~child. Each lies in an axis-aligned
/// box and in a slab between two planes across its mean normal: a patch of surface fills its box
/// badly and its slab well. An unused slot has an inverted box (lo = huge, hi = -huge), which no
/// query enters; a child too large for a slab has a zero normal and infinite offsets.
struct WideNode {
  std::array<Float4, 3> lo;  ///< per axis, the four children's lower bounds
  std::array<Float4, 3> hi;
  std::array<Float4, 3> normal;  ///< unit, per axis
  Float4 slab_lo;                ///< smallest normal . point
  Float4 slab_hi;
  std::array<std::int32_t, 4> child;
};

/// Up to four triangles; unused places repeat the last one.
struct TriangleLeaf {
  std::array<std::array<std::int32_t, 4>, 3> vertex;  ///< [corner][place], index into vertices
  std::array<std::int32_t, 4> face;                   ///< triangle number; ~number where repeated
  [[nodiscard]] bool repeated(std::size_t place) const { return face[place] < 0; }
  /// Of places that have anything new: one leaf in five is half empty.
  [[nodiscard]] std::size_t pairs() const { return repeated(2) ? 1 : 2; }
  [[nodiscard]] int triangle(std::size_t place) const {
    return repeated(place) ? ~face[place] : face[place];
  }
};

/// Everything is kept in a local frame: local = (point - centre) * scale, scale a power of two that
/// brings the bounding box's diagonal into [0.5, 1), so boxes in single precision serve surfaces of
/// any size and place, and scaling loses no digits.
struct WideTree {
  Eigen::Vector3d centre;
  double scale = 1;
  Eigen::Vector3d lower;  ///< of the whole surface, local
  Eigen::Vector3d upper;
  std::vector<WideNode> nodes;  ///< the root first
  std::vector<TriangleLeaf> leaves;
  std::vector<Eigen::Vector3d> vertices;  ///< local, in the order in which the leaves use them

  [[nodiscard]] const TriangleLeaf& leaf(std::int32_t child) const {
    const std::int32_t index = ~child;
    return leaves[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& point) const {
    return (point - centre) * scale;
  }
};

/// Boxes and slabs are wider than their triangles by this (local units): more than all rounding of
/// a query's single-precision tests within the frame.
inline constexpr float box_margin = 0x1p-20F;

/// Deepest stack that a traversal of a tree by build_wide_tree can need.
inline constexpr int traversal_stack = 256;

/// Binned surface-area heuristic (Wald 2007) that counts a leaf of one to four triangles as one.
/// Precondition: at least one face. O(#F log #F). The same tree from any number of threads.
[[nodiscard]] WideTree build_wide_tree(const Surface& surface, int threads);

}  // namespace curveskel
