// Polygons to triangles by ear clipping (Meisters 1975).
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <curveskel/clean.hpp>

namespace curveskel {
namespace {

/// The ends of an edge or diagonal, smaller first, as one number.
std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// A polygon of at least three corners, in its mean plane, that loses one ear after the other.
class EarClipping {
 public:
  EarClipping(const Positions& positions, std::span<const std::int32_t> corners,
              const std::vector<std::uint64_t>& banned)
      : corners_(corners), banned_(banned), points_(corners.size()), ring_(corners.size()) {
    // Newell's normal is the vector area; its plane fits bent polygons best.
    const Eigen::Vector3d origin = positions.row(corners[0]);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d a = positions.row(corners[i]).transpose() - origin;
      const Eigen::Vector3d b =
          positions.row(corners[(i + 1) % corners.size()]).transpose() - origin;
      normal += a.cross(b);
    }
    const double length = normal.stableNorm();
    normal = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d x = normal.unitOrthogonal();
    const Eigen::Vector3d y = normal.cross(x);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d p = positions.row(corners[i]).transpose() - origin;
      points_[i] = {p.dot(x), p.dot(y)};
      ring_[i] = {(i + corners.size() - 1) % corners.size(), (i + 1) % corners.size()};
    }
  }

  /// Writes #corners - 2 triangles.
  void clip(std::int32_t* triangle) {
    std::size_t here = first_corner();
    for (std::size_t left = corners_.size(); left > 3; --left) {
      const std::size_t ear = find_ear(here, left);
      const auto [before, after] = ring_[ear];
      triangle = write(triangle, ear);
      ring_[before].after = after;
      ring_[after].before = before;
      here = ring_[after].after;  // taking every other corner avoids fans of slivers
    }
    write(triangle, here);
  }

 private:
  struct Links {
    std::size_t before = 0;
    std::size_t after = 0;
  };

  /// Of a quadrilateral's diagonals the shorter one is tried first.
  [[nodiscard]] std::size_t first_corner() const {
    if (corners_.size() != 4) return 1;
    return (points_[1] - points_[3]).squaredNorm() < (points_[0] - points_[2]).squaredNorm() ? 0
                                                                                             : 1;
  }

  std::int32_t* write(std::int32_t* triangle, std::size_t ear) const {
    const auto [before, after] = ring_[ear];
    *triangle++ = corners_[before];
    *triangle++ = corners_[ear];
    *triangle++ = corners_[after];
    return triangle;
  }

  /// The first proper ear from `start` on; in a degenerate polygon the best of all corners.
  [[nodiscard]] std::size_t find_ear(std::size_t start, std::size_t left) const {
    std::size_t best = start;
    int best_rank = -1;
    for (std::size_t i = 0, corner = start; i < left; ++i, corner = ring_[corner].after) {
      const auto [before, after] = ring_[corner];
      if (!is_convex(corner) || !is_empty(corner)) continue;
      const bool free = !std::binary_search(banned_.begin(), banned_.end(),
                                            edge_key(corners_[before], corners_[after]));
      if (free) return corner;
      if (best_rank < 0) {
        best = corner;
        best_rank = 0;
      }
    }
    return best;
  }

  /// Collinear corners are no ears: their triangle would have no area.
  [[nodiscard]] bool is_convex(std::size_t corner) const {
    constexpr double least_sine = 1e-10;
    const auto [before, after] = ring_[corner];
    const double lengths =
        (points_[corner] - points_[before]).norm() * (points_[after] - points_[corner]).norm();
    return cross(points_[before], points_[corner], points_[after]) > least_sine * lengths;
  }

  [[nodiscard]] bool is_empty(std::size_t corner) const {
    const auto [before, after] = ring_[corner];
    const Eigen::Vector2d& a = points_[before];
    const Eigen::Vector2d& b = points_[corner];
    const Eigen::Vector2d& c = points_[after];
    for (std::size_t other = ring_[after].after; other != before; other = ring_[other].after) {
      const Eigen::Vector2d& p = points_[other];
      if (p == a || p == b || p == c) continue;  // a hole's bridge passes its ends twice
      if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::span<const std::int32_t> corners_;
  const std::vector<std::uint64_t>& banned_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Links> ring_;
};

/// Polygons without corners that repeat the one before them.
PolygonSoup without_repeats(const PolygonSoup& soup) {
  PolygonSoup result;
  result.offsets.push_back(0);
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const std::size_t first = result.corners.size();
    for (std::int64_t i = soup.offsets[p]; i < soup.offsets[p + 1]; ++i) {
      const std::int32_t corner = soup.corners[static_cast<std::size_t>(i)];
      if (result.corners.size() == first || result.corners.back() != corner) {
        result.corners.push_back(corner);
      }
    }
    while (result.corners.size() > first + 1 && result.corners.back() == result.corners[first]) {
      result.corners.pop_back();
    }
    // A polygon without three corners becomes one degenerate triangle, for `clean` to count.
    while (result.corners.size() > first && result.corners.size() < first + 3) {
      result.corners.push_back(result.corners[first]);
    }
    result.offsets.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  return result;
}

std::span<const std::int32_t> polygon(const PolygonSoup& soup, std::size_t p) {
  const auto begin = static_cast<std::size_t>(soup.offsets[p]);
  return std::span(soup.corners)
      .subspan(begin, static_cast<std::size_t>(soup.offsets[p + 1]) - begin);
}

/// Diagonals, sorted, that occur twice or are edges: they would have more than two triangles.
std::vector<std::uint64_t> crowded_diagonals(const PolygonSoup& soup, const Triangles& triangles,
                                             const std::vector<std::int64_t>& first_triangle) {
  std::vector<std::uint64_t> edges;
  std::vector<std::uint64_t> diagonals;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = polygon(soup, p);
    edges.clear();
    for (std::size_t i = 0; corners.size() > 3 && i < corners.size(); ++i) {
      edges.push_back(edge_key(corners[i], corners[(i + 1) % corners.size()]));
    }
    for (std::int64_t t = first_triangle[p]; t < first_triangle[p + 1]; ++t) {
      for (int k = 0; corners.size() > 3 && k < 3; ++k) {
        const std::uint64_t key = edge_key(triangles(t, k), triangles(t, (k + 1) % 3));
        if (std::find(edges.begin(), edges.end(), key) != edges.end()) continue;
        edges.push_back(key);  // its other triangle is in this polygon too
        diagonals.push_back(key);
      }
    }
  }
  std::sort(diagonals.begin(), diagonals.end());
  std::vector<std::uint64_t> crowded;
  for (std::size_t i = 1; i < diagonals.size(); ++i) {
    if (diagonals[i] == diagonals[i - 1]) crowded.push_back(diagonals[i]);
  }
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = polygon(soup, p);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint64_t key = edge_key(corners[i], corners[(i + 1) % corners.size()]);
      if (std::binary_search(diagonals.begin(), diagonals.end(), key)) crowded.push_back(key);
    }
  }
  std::sort(crowded.begin(), crowded.end());
  crowded.erase(std::unique(crowded.begin(), crowded.end()), crowded.end());
  return crowded;
}

}  // namespace

Triangles triangulate(const PolygonSoup& given) {
  const auto polygons = static_cast<std::int64_t>(given.offsets.size()) - 1;
  bool only_triangles = given.corners.size() == static_cast<std::size_t>(3 * polygons);
  for (std::int64_t p = 0; only_triangles && p < polygons; ++p) {
    only_triangles = given.offsets[static_cast<std::size_t>(p)] == 3 * p;
  }
  if (only_triangles) return Eigen::Map<const Triangles>(given.corners.data(), polygons, 3);

  const PolygonSoup soup = without_repeats(given);
  std::vector<std::int64_t> first_triangle{0};
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = static_cast<std::int64_t>(polygon(soup, p).size());
    first_triangle.push_back(first_triangle.back() + std::max<std::int64_t>(corners - 2, 0));
  }
  Triangles triangles(first_triangle.back(), 3);
  std::vector<std::uint64_t> banned;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
      const auto corners = polygon(soup, p);
      std::int32_t* const target = triangles.data() + 3 * first_triangle[p];
      if (corners.size() == 3 && round == 0) std::copy(corners.begin(), corners.end(), target);
      if (corners.size() > 3) EarClipping(given.positions, corners, banned).clip(target);
    }
    const auto crowded = crowded_diagonals(soup, triangles, first_triangle);
    const std::size_t before = banned.size();
    banned.insert(banned.end(), crowded.begin(), crowded.end());
    std::sort(banned.begin(), banned.end());
    banned.erase(std::unique(banned.begin(), banned.end()), banned.end());
    if (banned.size() == before) break;
  }
  return triangles;
}

}  // namespace curveskel
