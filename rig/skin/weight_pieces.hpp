// The pieces of a surface in which a joint's weights lie. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>
#include "base/buckets.hpp"

namespace curveskel {

/// A vertex's joints, ascending, and their shares, of sum 1.
using WeightRow = std::vector<std::pair<int, double>>;

/// The largest `kept` of these shares, of sum 1, joints ascending.
[[nodiscard]] WeightRow largest_shares(WeightRow row, std::size_t kept);

/// Of each vertex the first in its place: 1e-6 of D is no distance. O(#V) unless many coincide.
[[nodiscard]] std::vector<int> welded_places(const Surface& surface);

/// A surface as weights see it: vertices in one place are one, the first of them.
struct WeldedSurface {
  /// Each vertex in a place of its own. O(#F log #F).
  explicit WeldedSurface(const Surface& surface);
  /// `place_of` as `place`. O(#F log #F).
  WeldedSurface(const Surface& surface, std::vector<int> place_of);

  [[nodiscard]] std::span<const std::int32_t> neighbours(int place_number) const;

  std::vector<int> place;                  ///< of each vertex the first in its place
  std::vector<std::pair<int, int>> edges;  ///< between places, each once, the lower first
  Buckets<std::int32_t> neighbours_at;     ///< by place
  std::vector<int> component;              ///< by vertex
  Eigen::VectorXd areas;                   ///< by place: a third of the faces around it
};

/// Finds the pieces of one joint after another in the same memory.
class WeightPieces {
 public:
  /// A joint moves the vertices of which it has more than this share.
  static constexpr double moved_share = 0.1;

  struct Member {
    int place = 0;
    double share = 0;
  };
  /// Vertices that the joint moves and that faces connect.
  struct Piece {
    std::vector<int> places;
    int component = 0;
    double weight = 0;       ///< sum of area times share
    bool is_island = false;  ///< not the heaviest in its component
  };

  /// Precondition: the surface outlives this.
  explicit WeightPieces(const WeldedSurface& surface);

  /// The pieces of the joint that has these shares, one member a place. O(members).
  [[nodiscard]] std::vector<Piece> find(std::span<const Member> members);

  /// The same with each piece grown to all vertices of which the joint has any share, those that
  /// several pieces reach to the one that needs the fewest steps.
  [[nodiscard]] std::vector<Piece> find_grown(std::span<const Member> members);

 private:
  [[nodiscard]] std::vector<Piece> find_marked(std::span<const Member> members);
  [[nodiscard]] Piece piece_from(int place, int number);
  void grow(std::vector<Piece>& pieces);
  void mark(std::span<const Member> members);

  const WeldedSurface& surface_;
  std::vector<double> share_;  // by place, 0 for all but the members
  std::vector<int> piece_;     // by place, none for all that are in none
};

/// Takes a joint's islands from it: the other joints of the vertices there have all, and a vertex
/// without others the mean of its neighbours' rows, of which the largest `kept` shares stay that
/// are no smaller than `least`.
/// Again, four times at most, as what is left may have islands in turn.
/// Precondition: a row for each vertex of the surface. O((#V + #F) log #F).
[[nodiscard]] SkinWeights without_islands(const Surface& surface, const SkinWeights& weights,
                                          std::size_t kept, double least = 0);

}  // namespace curveskel
