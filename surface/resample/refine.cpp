#include "surface/resample/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>

namespace curveskel {
namespace {

using Index = std::int32_t;

// A side from face f's corner k to the next has the slot 3 f + k.
struct Side {
  std::pair<Index, Index> ends;
  std::size_t slot;
  double length;
};

std::vector<Side> sides_longer_than(const Surface& surface, double longest) {
  std::vector<Side> sides;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Index a = surface.triangles(f, k);
      const Index b = surface.triangles(f, (k + 1) % 3);
      // Both directions give the same difference up to its sign, so both sides agree.
      const double length = (surface.positions.row(a) - surface.positions.row(b)).norm();
      if (length > longest) {
        sides.push_back({std::minmax(a, b), static_cast<std::size_t>(3 * f + k), length});
      }
    }
  }
  return sides;
}

// Leaves the longest of them, at most two for each vertex that there is room for; where more are
// equally long, all of these.
void keep_longest(std::vector<Side>& sides, std::size_t room) {
  if (sides.size() / 2 <= room) return;
  const auto first_out = sides.begin() + static_cast<std::ptrdiff_t>(2 * room);
  std::nth_element(sides.begin(), first_out, sides.end(),
                   [](const Side& a, const Side& b) { return a.length > b.length; });
  const double bound = first_out->length;
  const bool all_tie =
      std::none_of(sides.begin(), first_out, [&](const Side& side) { return side.length > bound; });
  std::erase_if(sides, [&](const Side& side) {
    return all_tie ? side.length < bound : side.length <= bound;
  });
}

// The middle vertex of every side, -1 for a side that is not cut, by slot. Appends the middles to
// the positions.
std::vector<Index> cut_sides(Surface& surface, double longest, std::size_t room) {
  std::vector<Side> sides = sides_longer_than(surface, longest);
  keep_longest(sides, room);
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.ends, a.slot) < std::tie(b.ends, b.slot);
  });
  std::vector<Index> middles(static_cast<std::size_t>(surface.triangles.size()), -1);
  auto next = static_cast<Index>(surface.positions.rows());
  // Closed: every edge has two sides.
  surface.positions.conservativeResize(next + static_cast<Eigen::Index>(sides.size() / 2), 3);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const auto [a, b] = sides[i].ends;
    surface.positions.row(next) = (surface.positions.row(a) + surface.positions.row(b)) / 2;
    middles[sides[i].slot] = middles[sides[i + 1].slot] = next++;
  }
  return middles;
}

/// Cuts every edge longer than `longest` at its middle, and its triangles with it, the longest
/// edges first, until none is left or there are `vertices_enough`.
Surface split(const Surface& surface, double longest, std::size_t vertices_enough) {
  Surface result = surface;
  for (;;) {
    const auto vertices = static_cast<std::size_t>(result.positions.rows());
    if (vertices >= vertices_enough) return result;
    const std::vector<Index> middles = cut_sides(result, longest, vertices_enough - vertices);
    if (std::all_of(middles.begin(), middles.end(), [](Index m) { return m < 0; })) return result;
    std::vector<std::array<Index, 3>> faces;
    faces.reserve(middles.size());
    for (Eigen::Index f = 0; f < result.triangles.rows(); ++f) {
      const Index* cut = &middles[static_cast<std::size_t>(3 * f)];
      const auto count = (cut[0] >= 0) + (cut[1] >= 0) + (cut[2] >= 0);
      // Turn the face so that with one cut it is the first side, with two the third is whole.
      int turn = 0;
      if (count == 1) turn = cut[0] >= 0 ? 0 : cut[1] >= 0 ? 1 : 2;
      if (count == 2) turn = cut[2] < 0 ? 0 : cut[0] < 0 ? 1 : 2;
      const auto at = [&](int k) { return (k + turn) % 3; };
      const Index a = result.triangles(f, at(0));
      const Index b = result.triangles(f, at(1));
      const Index c = result.triangles(f, at(2));
      const Index ab = cut[at(0)];
      const Index bc = cut[at(1)];
      const Index ca = cut[at(2)];
      if (count == 0) {
        faces.push_back({a, b, c});
      } else if (count == 1) {
        faces.push_back({a, ab, c});
        faces.push_back({ab, b, c});
      } else if (count == 2) {
        faces.push_back({ab, b, bc});
        // The shorter diagonal of the trapezium that is left.
        const auto length = [&](Index i, Index j) {
          return (result.positions.row(i) - result.positions.row(j)).squaredNorm();
        };
        if (length(a, bc) < length(ab, c)) {
          faces.push_back({a, ab, bc});
          faces.push_back({a, bc, c});
        } else {
          faces.push_back({a, ab, c});
          faces.push_back({ab, bc, c});
        }
      } else {
        faces.push_back({a, ab, ca});
        faces.push_back({b, bc, ab});
        faces.push_back({c, ca, bc});
        faces.push_back({ab, bc, ca});
      }
    }
    result.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      result.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    }
  }
}

}  // namespace

Surface refine(const Surface& surface, int least_vertices) {
  Surface result = surface;
  if (result.positions.rows() >= least_vertices) return result;
  // From four times the side of the equilateral triangles that would cover the surface with so many
  // vertices. Needles, whose area says nothing of their length, would give any number of them.
  const auto vertices_enough = 2 * static_cast<std::size_t>(least_vertices);
  double longest = 4 * std::sqrt(2 / std::sqrt(3.0) * area(surface) / least_vertices);
  for (; result.positions.rows() < least_vertices && longest > 0; longest *= 0.85) {
    result = split(result, longest, vertices_enough);
  }
  return result;
}

}  // namespace curveskel
