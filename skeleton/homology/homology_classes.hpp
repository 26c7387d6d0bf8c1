// Do a skeleton's cycles go round the handles?
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The number of the skeleton's cycles that are independent in the enclosed solid: the rank of its
/// homology there (coefficients in Z/2). A cycle that goes along a handle and comes back, or lies
/// in a ball, counts nothing; two that go round the same handle count once. For a skeleton inside
/// it is at most the surface's genus.
///
/// Loops on the surface generate the homology of the outside, and linking numbers pair that
/// perfectly with the homology inside (Alexander duality). So it is the rank of the matrix of the
/// linking numbers of cycles with loops, counted as crossings in a projection.
/// Precondition: surface closed, no position NaN or infinite. O(#F) and, with g handles and loops
/// of n edges, O(g n + (#N + cycles g) g / 64).
[[nodiscard]] int homology_rank(const Surface& surface, const CurveSkeleton& skeleton);

/// A row of numbers in Z/2, 64 to a word.
using BitRow = std::vector<std::uint64_t>;

/// The linking numbers of closed polygons (the last point is joined to the first) with the loops
/// that generate the homology outside: a row for each, zero where the polygon goes round no handle.
[[nodiscard]] std::vector<BitRow> linking_numbers(
    const Surface& surface, const std::vector<std::vector<Eigen::Vector3d>>& polygons);

/// Rows that were added, each reduced by those before it, to tell independent rows.
class IndependentRows {
 public:
  /// True, and the row is kept, if it is no sum of those kept before. O(kept rows x words).
  bool add(BitRow row);
  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }

 private:
  std::vector<BitRow> rows_;
  std::vector<std::size_t> pivots_;  // the lowest bit that is set, per row
};

/// Tells whether curves inside a surface go round the same handles, in far less time than a rank
/// takes: each loop gets a number of 64 random bits, and a curve the sum modulo 2 of the numbers of
/// those that it links oddly. Wrong once in 2^64 times. Only one thread may ask at a time.
class HomologyClasses {
 public:
  explicit HomologyClasses(const Surface& surface);  ///< closed

  [[nodiscard]] bool has_handles() const;

  /// Of the polygon that goes along the first line and back along the second: whether it goes round
  /// no handle. Precondition: neither is empty. O(points), with short edges.
  [[nodiscard]] bool homologous(const std::vector<Eigen::Vector3d>& there,
                                const std::vector<Eigen::Vector3d>& back);

 private:
  struct Implementation;
  std::shared_ptr<Implementation> implementation_;
};

}  // namespace curveskel
