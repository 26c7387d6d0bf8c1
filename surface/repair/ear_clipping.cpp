#include "surface/repair/ear_clipping.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>

#include <curveskel/monitor.hpp>
#include "surface/repair/points_in_cells.hpp"

namespace curveskel {
namespace {

constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

/// A polygon in its mean plane, that loses one corner after the other.
class FlatPolygon {
 public:
  struct Links {
    std::size_t before = 0;
    std::size_t after = 0;
  };

  FlatPolygon(const Positions& positions, std::span<const std::int32_t> corners)
      : corners_(corners), points_(corners.size()), ring_(corners.size()) {
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

  [[nodiscard]] const std::vector<Eigen::Vector2d>& points() const { return points_; }
  [[nodiscard]] const Links& at(std::size_t corner) const { return ring_[corner]; }
  [[nodiscard]] std::uint64_t diagonal_at(std::size_t corner) const {
    return edge_key(corners_[ring_[corner].before], corners_[ring_[corner].after]);
  }

  /// Of a quadrilateral's diagonals the shorter one is tried first, of equal ones that of the
  /// smallest vertex, so that copies of a quadrilateral agree on it.
  [[nodiscard]] std::size_t first_corner() const {
    constexpr double rounding = 1e-12;
    if (corners_.size() != 4) return 1;
    const double odd = (points_[1] - points_[3]).squaredNorm();
    const double even = (points_[0] - points_[2]).squaredNorm();
    if (std::abs(odd - even) > rounding * std::max(odd, even)) return odd < even ? 0 : 1;
    const auto smallest = std::min_element(corners_.begin(), corners_.end()) - corners_.begin();
    return smallest % 2 == 0 ? 1 : 0;
  }

  std::int32_t* write(std::int32_t* triangle, std::size_t ear) const {
    *triangle++ = corners_[ring_[ear].before];
    *triangle++ = corners_[ear];
    *triangle++ = corners_[ring_[ear].after];
    return triangle;
  }

  void remove(std::size_t ear) {
    const auto [before, after] = ring_[ear];
    ring_[before].after = after;
    ring_[after].before = before;
  }

  /// Collinear corners are no ears: their triangle would have no area.
  [[nodiscard]] bool is_convex(std::size_t corner) const {
    constexpr double least_sine = 1e-10;
    const auto [before, after] = ring_[corner];
    const double lengths =
        (points_[corner] - points_[before]).norm() * (points_[after] - points_[corner]).norm();
    return cross(points_[before], points_[corner], points_[after]) > least_sine * lengths;
  }

  /// True if the other corner lies in the triangle of this one and its neighbours.
  [[nodiscard]] bool blocks(std::size_t other, std::size_t corner) const {
    const auto [before, after] = ring_[corner];
    if (other == before || other == corner || other == after) return false;
    const Eigen::Vector2d& a = points_[before];
    const Eigen::Vector2d& b = points_[corner];
    const Eigen::Vector2d& c = points_[after];
    const Eigen::Vector2d& p = points_[other];
    if (p == a || p == b || p == c) return false;  // a hole's bridge passes its ends twice
    return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
  }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                      const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }

  std::span<const std::int32_t> corners_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Links> ring_;
};

bool is_banned(const FlatPolygon& polygon, std::size_t corner,
               const std::vector<std::uint64_t>& banned) {
  return std::binary_search(banned.begin(), banned.end(), polygon.diagonal_at(corner));
}

/// Looks at each corner anew for each ear: quickest for few corners.
class EarsByLooking {
 public:
  EarsByLooking(FlatPolygon& polygon, const std::vector<std::uint64_t>& banned)
      : polygon_(polygon), banned_(banned), left_(polygon.points().size()) {}

  /// The first proper ear from `start` on; in a degenerate polygon `start`.
  [[nodiscard]] std::size_t next(std::size_t start) const {
    std::size_t second_best = nothing;
    std::size_t corner = start;
    for (std::size_t i = 0; i < left_; ++i, corner = polygon_.at(corner).after) {
      if (!polygon_.is_convex(corner) || !is_empty(corner)) continue;
      if (!is_banned(polygon_, corner, banned_)) return corner;
      if (second_best == nothing) second_best = corner;
    }
    return second_best == nothing ? start : second_best;
  }

  void remove(std::size_t ear) {
    polygon_.remove(ear);
    --left_;
  }

 private:
  [[nodiscard]] bool is_empty(std::size_t corner) const {
    const auto [before, after] = polygon_.at(corner);
    for (std::size_t o = polygon_.at(after).after; o != before; o = polygon_.at(o).after) {
      if (polygon_.blocks(o, corner)) return false;
    }
    return true;
  }

  FlatPolygon& polygon_;
  const std::vector<std::uint64_t>& banned_;
  std::size_t left_;
};

/// Keeps the ears, and of each convex corner that is none another corner that makes it so: only if
/// that one goes is it looked at again. Finds the same ears as `EarsByLooking`.
class EarsKept {
 public:
  EarsKept(FlatPolygon& polygon, const std::vector<std::uint64_t>& banned)
      : polygon_(polygon),
        banned_(banned),
        cells_(polygon.points()),
        blocked_by_(polygon.points().size(), nothing),
        waiting_(polygon.points().size()) {
    for (std::size_t corner = 0; corner < blocked_by_.size(); ++corner) look_at(corner);
  }

  [[nodiscard]] std::size_t next(std::size_t start) const {
    for (const std::set<std::size_t>* ears : {&free_, &second_best_}) {
      if (ears->empty()) continue;
      const auto found = ears->lower_bound(start);
      return found == ears->end() ? *ears->begin() : *found;
    }
    return start;
  }

  void remove(std::size_t ear) {
    forget(ear);
    cells_.remove(ear);
    const auto [before, after] = polygon_.at(ear);
    polygon_.remove(ear);
    look_at(before);
    look_at(after);
    for (const std::size_t corner : waiting_[ear]) {
      if (blocked_by_[corner] == ear) look_at(corner);
    }
    waiting_[ear] = {};
  }

 private:
  void forget(std::size_t corner) {
    free_.erase(corner);
    second_best_.erase(corner);
    blocked_by_[corner] = nothing;
  }

  void look_at(std::size_t corner) {
    forget(corner);
    if (!polygon_.is_convex(corner)) return;
    const auto& points = polygon_.points();
    const auto [before, after] = polygon_.at(corner);
    const auto blocker =
        cells_.find_in({points[before], points[corner], points[after]},
                       [&](std::size_t other) { return polygon_.blocks(other, corner); });
    if (blocker) {
      blocked_by_[corner] = *blocker;
      waiting_[*blocker].push_back(corner);
    } else {
      (is_banned(polygon_, corner, banned_) ? second_best_ : free_).insert(corner);
    }
  }

  FlatPolygon& polygon_;
  const std::vector<std::uint64_t>& banned_;
  PointsInCells cells_;
  std::set<std::size_t> free_;
  std::set<std::size_t> second_best_;  // with banned diagonals
  std::vector<std::size_t> blocked_by_;
  std::vector<std::vector<std::size_t>> waiting_;  // for the corner to go, by corner
};

template <typename Ears>
void clip(const FlatPolygon& polygon, Ears ears, const std::stop_token& stop,
          std::int32_t* triangle) {
  std::size_t here = polygon.first_corner();
  for (std::size_t left = polygon.points().size(); left > 3; --left) {
    if (left % 64 == 0) throw_if_stopped(stop);
    const std::size_t ear = ears.next(here);
    triangle = polygon.write(triangle, ear);
    const std::size_t after = polygon.at(ear).after;
    ears.remove(ear);
    here = polygon.at(after).after;  // taking every other corner avoids fans of slivers
  }
  polygon.write(triangle, here);
}

}  // namespace

void clip_ears(const Positions& positions, std::span<const std::int32_t> corners,
               const std::vector<std::uint64_t>& banned, const std::stop_token& stop,
               std::int32_t* triangle) {
  constexpr std::size_t most_to_look_through = 100;
  FlatPolygon polygon(positions, corners);
  if (corners.size() <= most_to_look_through) {
    clip(polygon, EarsByLooking(polygon, banned), stop, triangle);
  } else {
    clip(polygon, EarsKept(polygon, banned), stop, triangle);
  }
}

}  // namespace curveskel
