// The surface that a curve is embedded in, and all that the steps ask of it again and again.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/surface.hpp>
#include "base/buckets.hpp"
#include "surface/mesh/half_edges.hpp"

namespace curveskel {

/// A closed, oriented surface with the inscribed balls of its vertices, both kept by reference.
/// All else is made when first asked for, as many surfaces need only a part of it, and then kept.
/// For one thread.
class WorkingSurface {
 public:
  WorkingSurface(const Surface& surface, const InscribedBalls& balls)
      : surface_(surface), balls_(balls) {}

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] const InscribedBalls& balls() const { return balls_; }
  [[nodiscard]] int vertices() const { return static_cast<int>(surface_.positions.rows()); }
  [[nodiscard]] Eigen::Vector3d place(int vertex) const { return surface_.positions.row(vertex); }

  /// Per vertex a third of the area of the triangles around it.
  [[nodiscard]] const Eigen::VectorXd& vertex_areas() const;
  /// The vertices along edges.
  [[nodiscard]] const Graph& neighbours() const;
  /// Per vertex the triangles that it is a corner of, ascending.
  [[nodiscard]] const Buckets<std::int32_t>& triangles_around() const;
  [[nodiscard]] const HalfEdges& half_edges() const;
  /// Per vertex the first half-edge that leaves it.
  [[nodiscard]] const std::vector<std::int32_t>& leaving() const;

 private:
  const Surface& surface_;
  const InscribedBalls& balls_;
  mutable std::optional<Eigen::VectorXd> vertex_areas_;
  mutable std::optional<Graph> neighbours_;
  mutable std::optional<Buckets<std::int32_t>> triangles_around_;
  mutable std::optional<HalfEdges> half_edges_;
  mutable std::optional<std::vector<std::int32_t>> leaving_;
};

}  // namespace curveskel
