// Curves just below a surface: where there is no other way, there is this one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// The inner side of a triangle; no direction if it has no area.
struct InnerSide {
  Point inwards = Point::Zero();
  double height = 0;  ///< the triangle's least
};
[[nodiscard]] InnerSide inner_side(const Surface& surface, std::int32_t face);

/// From triangle to triangle, as below a vertex there may be no inside at all; a hundredth of a
/// triangle's least height below it, and 5e-7 at least. Such a curve lies inside unless the surface
/// meets itself, or comes as near to itself as that. Precondition: closed, oriented, D = 1.
class BelowSurface {
 public:
  explicit BelowSurface(const WorkingSurface& working);  ///< kept by reference

  /// Across edges, given by their ends, of which each shares a triangle with the next, the last one
  /// with the first.
  [[nodiscard]] std::vector<Point> round(const std::vector<std::array<int, 2>>& edges) const;

  /// From one vertex's triangle to that of its neighbour, round both. All steps from and to a
  /// vertex begin and end at the same point.
  [[nodiscard]] std::vector<Point> step(int from, int to) const;

  /// Once round a vertex from where its steps begin: the first point and every other one below a
  /// triangle, those between below edges.
  [[nodiscard]] std::vector<Point> around(int vertex) const;

 private:
  struct Place {
    Point inwards = Point::Zero();
    double depth = 0;
  };
  [[nodiscard]] int origin(std::int32_t h) const { return surface_.triangles(h / 3, h % 3); }
  [[nodiscard]] Point place(std::int32_t h) const { return surface_.positions.row(origin(h)); }
  [[nodiscard]] std::int32_t turned(std::int32_t h) const;  // the next one around its origin
  [[nodiscard]] std::int32_t half_edge(const std::array<int, 2>& edge) const;
  [[nodiscard]] Place below_face(std::int32_t face) const;
  [[nodiscard]] Point below_triangle(std::int32_t face) const;
  [[nodiscard]] Point below_edge(std::int32_t h) const;

  const Surface& surface_;
  const HalfEdges& half_;
  const std::vector<std::int32_t>& out_;  // per vertex, one half-edge that leaves it
};

}  // namespace curveskel
