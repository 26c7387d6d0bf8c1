#include "viewer/software/simpler_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <curveskel/monitor.hpp>
#include "viewer/render/camera.hpp"

namespace curveskel::viewer {
namespace {

float area_of(const ShownSurface& surface) {
  double sum = 0;
  for (const glm::uvec3& triangle : surface.triangles) {
    const glm::vec3& a = surface.positions[triangle.x];
    sum += 0.5 * static_cast<double>(glm::length(glm::cross(surface.positions[triangle.y] - a,
                                                            surface.positions[triangle.z] - a)));
  }
  return static_cast<float>(sum);
}

/// The number of the cell of each vertex, 21 bits a coordinate.
std::vector<std::uint64_t> cells_of(const ShownSurface& given, float size) {
  constexpr float most = (1U << 21U) - 1;
  const Bounds bounds = bounds_of(given.positions);
  std::vector<std::uint64_t> cells;
  cells.reserve(given.positions.size());
  for (const glm::vec3& position : given.positions) {
    const glm::vec3 place =
        glm::clamp(glm::floor((position - bounds.low) / size), glm::vec3(0), glm::vec3(most));
    cells.push_back(static_cast<std::uint64_t>(place.x) << 42U |
                    static_cast<std::uint64_t>(place.y) << 21U |
                    static_cast<std::uint64_t>(place.z));
  }
  return cells;
}

}  // namespace

SimplerSurface simpler_surface(const ShownSurface& given, std::size_t vertices,
                               const std::stop_token& stop) {
  SimplerSurface simpler;
  const float size = std::sqrt(std::max(area_of(given), 1e-30F) /
                               static_cast<float>(std::max<std::size_t>(vertices, 1)));
  const std::vector<std::uint64_t> cells = cells_of(given, size);
  std::vector<std::uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0U);
  throw_if_stopped(stop);
  constexpr std::size_t per_look = 1U << 19U;  // some milliseconds
  std::size_t compared = 0;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (++compared % per_look == 0) throw_if_stopped(stop);
    return cells[a] != cells[b] ? cells[a] < cells[b] : a < b;
  });
  std::vector<std::uint32_t> cluster(cells.size());
  ShownSurface& surface = simpler.surface;
  for (std::size_t first = 0; first < order.size();) {
    glm::vec3 sum(0);
    std::size_t last = first;
    for (; last < order.size() && cells[order[last]] == cells[order[first]]; ++last) {
      cluster[order[last]] = static_cast<std::uint32_t>(simpler.vertex_of_given.size());
      sum += given.positions[order[last]];
    }
    simpler.vertex_of_given.push_back(order[first]);
    surface.positions.push_back(sum / static_cast<float>(last - first));
    first = last;
  }
  throw_if_stopped(stop);
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& triangle : given.triangles) {
    const glm::uvec3 merged(cluster[triangle.x], cluster[triangle.y], cluster[triangle.z]);
    if (merged.x != merged.y && merged.y != merged.z && merged.z != merged.x) {
      triangles.push_back(merged);
    }
  }
  surface.triangles = std::move(triangles);
  set_normals(surface);
  return simpler;
}

std::vector<glm::uvec3> fewer_triangles(const ShownSurface& given, std::size_t vertices) {
  const SimplerSurface simpler = simpler_surface(given, vertices);
  const auto& corner = simpler.vertex_of_given;
  std::vector<glm::uvec3> triangles;
  triangles.reserve(simpler.surface.triangles.size());
  for (const glm::uvec3& triangle : simpler.surface.triangles) {
    triangles.emplace_back(corner[triangle.x], corner[triangle.y], corner[triangle.z]);
  }
  return triangles;
}

}  // namespace curveskel::viewer
