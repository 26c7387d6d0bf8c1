// The exact union of closed surfaces that meet.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// A union of several parts.
struct UnitedBody {
  std::vector<int> parts;  ///< ascending, two at least
  Surface surface;         ///< closed, outward, of one component
  int cavities = 0;        ///< that the parts close in between them: filled
};

/// Two parts that meet, and why no union came of the bodies that they belong to.
struct RefusedUnion {
  int one = 0;
  int other = 0;
  std::string why;
};

struct Unions {
  std::vector<UnitedBody> bodies;  ///< in the order of their first parts
  std::vector<RefusedUnion> refused;
};

/// Unites along `meeting` pairs, those with the fewest triangles first, so that each triangle is
/// copied O(log parts) times. Points of intersection are exact until the end, when each is rounded
/// to the nearest doubles. A union is refused, and its parts stay as they are, where a surface
/// crosses itself at the other, where they touch in an edge or a vertex so that what comes of it
/// would be no manifold, or where it has not the volume of a union. Throws Cancelled on a stop.
/// Deterministic.
[[nodiscard]] Unions unite(const std::vector<Component>& parts,
                           const std::vector<std::pair<int, int>>& meeting, const Monitor& monitor);

}  // namespace curveskel
