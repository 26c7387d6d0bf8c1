// Curves inside a surface that go round the same handles.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A row of numbers in Z/2, 64 to a word.
using BitRow = std::vector<std::uint64_t>;

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

  /// The sum modulo 2 of the numbers of the loops over which a straight line crosses. A closed
  /// polygon goes round no handle where the sum over its sides is 0. O(its length, with short
  /// edges).
  [[nodiscard]] std::uint64_t number(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  /// The linking numbers of closed polygons (the last point is joined to the first) with the loops
  /// that generate the homology outside: a row for each, zero where the polygon goes round no
  /// handle.
  [[nodiscard]] std::vector<BitRow> linking_numbers(
      const std::vector<std::vector<Eigen::Vector3d>>& polygons) const;

  /// See homology_rank. Precondition: the surface is one component.
  [[nodiscard]] int rank(const CurveSkeleton& skeleton) const;

 private:
  struct Implementation;
  std::shared_ptr<Implementation> implementation_;
};

}  // namespace curveskel
