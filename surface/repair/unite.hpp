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

/// Unites along `meeting` pairs, those with the fewest triangles first. Each point of intersection
/// is rounded to the nearest doubles. Where bodies then cross themselves (faces in one plane leave
/// slivers) they are united once more with one of them larger by a millionth of the parts' extent;
/// so no body crosses itself. A union is refused, and its parts stay as they are, where a surface
/// crosses itself, where they touch in an edge or a vertex only so that what comes of it would be
/// no manifold, or where it has not the volume of a union. Throws Cancelled on a stop.
/// Deterministic.
[[nodiscard]] Unions unite(const std::vector<Component>& parts,
                           const std::vector<std::pair<int, int>>& meeting, const Monitor& monitor);

}  // namespace curveskel
