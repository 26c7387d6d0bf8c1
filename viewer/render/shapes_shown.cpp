#include "viewer/render/shapes_shown.hpp"

#include <algorithm>
#include <cmath>

namespace curveskel::viewer {
namespace {

std::uint32_t packed(const glm::vec3& normal) {
  const auto part = [](float value) {
    constexpr float most = 511;
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * most)) & 1023U;
  };
  return part(normal.x) | part(normal.y) << 10U | part(normal.z) << 20U;
}

/// `corners(f)`: those of triangle f.
template <typename Corners>
void set_normals(ShownSurface& shown, std::size_t count, const Corners& corners) {
  std::vector<glm::vec3> sums(shown.positions.size(), glm::vec3(0));
  for (std::size_t f = 0; f < count; ++f) {
    const glm::uvec3 triangle = corners(f);
    const glm::vec3& a = shown.positions[triangle.x];
    const glm::vec3 normal =
        glm::cross(shown.positions[triangle.y] - a, shown.positions[triangle.z] - a);
    for (int corner = 0; corner < 3; ++corner) sums[triangle[corner]] += normal;
  }
  shown.normals.resize(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const float length = glm::length(sums[v]);
    shown.normals[v] = packed(length > 0 ? sums[v] / length : glm::vec3(0));
  }
}

}  // namespace

void set_normals(ShownSurface& shown) {
  set_normals(shown, shown.triangles.size(), [&](std::size_t f) { return shown.triangles[f]; });
}

void set_normals(ShownSurface& shown, const Triangles& triangles) {
  set_normals(shown, static_cast<std::size_t>(triangles.rows()), [&](std::size_t f) {
    const auto row = triangles.row(static_cast<Eigen::Index>(f));
    return glm::uvec3(row[0], row[1], row[2]);
  });
}

ShownSurface chosen_vertices(const ShownSurface& shown, const std::vector<std::uint32_t>& chosen) {
  ShownSurface result;
  result.positions.reserve(chosen.size());
  result.normals.reserve(chosen.size());
  for (const std::uint32_t vertex : chosen) {
    result.positions.push_back(shown.positions[vertex]);
    result.normals.push_back(shown.normals[vertex]);
  }
  return result;
}

DrawnSpace space_round(const Positions& points) {
  DrawnSpace space;
  if (points.rows() == 0) return space;
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const Eigen::RowVector3d high = points.colwise().maxCoeff();
  space.origin = (low + high) / 2;
  const double size = (high - low).stableNorm();
  if (std::isnormal(size)) space.unit = std::exp2(std::floor(std::log2(size)));
  return space;
}

glm::vec3 shown_point(const Eigen::RowVector3d& point, const DrawnSpace& space) {
  const Eigen::RowVector3f moved = ((point - space.origin) / space.unit).cast<float>();
  return {moved.x(), moved.y(), moved.z()};
}

Eigen::Vector3d model_point(const glm::vec3& point, const DrawnSpace& space) {
  return model_vector(point) * space.unit + space.origin.transpose();
}

float shown_length(double length, const DrawnSpace& space) {
  return static_cast<float>(length / space.unit);
}

void move_surface(ShownSurface& shown, const Positions& positions, const DrawnSpace& space) {
  shown.positions.resize(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    shown.positions[static_cast<std::size_t>(v)] = shown_point(positions.row(v), space);
  }
  set_normals(shown);
}

ShownSurface shown_surface(const Surface& surface, const DrawnSpace& space) {
  ShownSurface shown;
  std::vector<glm::uvec3> triangles(static_cast<std::size_t>(surface.triangles.rows()));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    triangles[static_cast<std::size_t>(f)] =
        glm::uvec3(surface.triangles(f, 0), surface.triangles(f, 1), surface.triangles(f, 2));
  }
  shown.triangles = std::move(triangles);
  move_surface(shown, surface.positions, space);
  return shown;
}

}  // namespace curveskel::viewer
