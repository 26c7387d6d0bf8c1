// Surfaces and skeletons in the form in which they are drawn.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>
#include "viewer/render/colours.hpp"

namespace curveskel::viewer {

/// The coordinates in which things are drawn: about an origin and in a unit of the model's size, so
/// that single precision serves a model of any size anywhere.
struct DrawnSpace {
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();
  double unit = 1;  ///< model units; a power of two, so that digits stay as they are
};

/// Of all these points.
[[nodiscard]] DrawnSpace space_round(const Positions& points);

/// A list of triangles that copies share: a recording has the same ones at hundreds of moments.
class SharedTriangles {
 public:
  using List = std::vector<glm::uvec3>;

  SharedTriangles() = default;
  /// By assignment, as a list is made first and shared then.
  SharedTriangles(List list) : list_(std::make_shared<const List>(std::move(list))) {}  // NOLINT
  [[nodiscard]] const List& list() const {
    static const List none;
    return list_ ? *list_ : none;
  }
  [[nodiscard]] std::size_t size() const { return list().size(); }
  [[nodiscard]] bool empty() const { return list().empty(); }
  [[nodiscard]] const glm::uvec3& operator[](std::size_t f) const { return list()[f]; }
  [[nodiscard]] List::const_iterator begin() const { return list().begin(); }
  [[nodiscard]] List::const_iterator end() const { return list().end(); }
  bool operator==(const SharedTriangles& other) const {
    return list_ == other.list_ || list() == other.list();
  }

 private:
  std::shared_ptr<const List> list_;
};

struct ShownSurface {
  std::vector<glm::vec3> positions;    ///< in a `DrawnSpace`
  std::vector<std::uint32_t> normals;  ///< packed as GL_INT_2_10_10_10_REV
  SharedTriangles triangles;
  std::vector<Rgba> colours;  ///< per vertex, or empty: the plain colour
  /// Of a simpler form with some of the vertices, for slow machines; empty where it is simple.
  SharedTriangles fewer;
};

/// With normals, without colours. O(#V + #F).
[[nodiscard]] ShownSurface shown_surface(const Surface& surface, const DrawnSpace& space);
/// Area-weighted vertex normals from positions and triangles. O(#V + #F).
void set_normals(ShownSurface& shown);
/// The same with other triangles than its own.
void set_normals(ShownSurface& shown, const Triangles& triangles);
/// Vertex i is vertex chosen[i]; without triangles and colours. O(#chosen).
[[nodiscard]] ShownSurface chosen_vertices(const ShownSurface& shown,
                                           const std::vector<std::uint32_t>& chosen);
/// The same where only positions have moved: triangles and colours stay.
void move_surface(ShownSurface& shown, const Positions& positions, const DrawnSpace& space);

/// A drawn edge: a cone's trunk with its own colours at the ends.
struct TubeInstance {
  glm::vec4 from;  ///< centre, radius
  glm::vec4 to;
  Rgba from_colour;
  Rgba to_colour;
  /// The direction of the next edge at an end: both are cut along the plane between them, whose
  /// normal this is. (0, 0, 0) = cut straight.
  glm::vec3 from_mitre{0};
  glm::vec3 to_mitre{0};
};

struct ShownSkeleton {
  std::vector<TubeInstance> edges;
  std::vector<TubeInstance> nodes;  ///< balls: `to` and `to_colour` are not used
};

/// In double precision, still as drawn.
[[nodiscard]] inline Eigen::Vector3d model_vector(const glm::vec3& vector) {
  return {static_cast<double>(vector.x), static_cast<double>(vector.y),
          static_cast<double>(vector.z)};
}
[[nodiscard]] glm::vec3 shown_point(const Eigen::RowVector3d& point, const DrawnSpace& space);
/// Back again.
[[nodiscard]] Eigen::Vector3d model_point(const glm::vec3& point, const DrawnSpace& space);
/// A length of the model as drawn.
[[nodiscard]] float shown_length(double length, const DrawnSpace& space);

}  // namespace curveskel::viewer
