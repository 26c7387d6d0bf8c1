#include "surface/repair/orient.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {

std::int64_t split_umbrellas(Surface& surface, const HalfEdges& half_edges) {
  std::int32_t* const corner = surface.triangles.data();
  const auto corners = static_cast<std::int32_t>(surface.triangles.size());
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  std::vector<bool> visited(idx(corners), false);
  std::vector<bool> taken(idx(vertices), false);
  std::vector<std::int32_t> original;  // per copy
  for (std::int32_t start = 0; start < corners; ++start) {
    if (visited[idx(start)]) continue;
    const std::int32_t vertex = corner[start];
    std::int32_t name = vertex;
    if (taken[idx(vertex)]) {
      name = vertices + static_cast<std::int32_t>(original.size());
      original.push_back(vertex);
    }
    taken[idx(vertex)] = true;
    // Leave each face by the edge at this corner that we did not come in by. The faces may still
    // be oriented either way.
    std::int32_t here = start;
    std::int32_t leaving = start;
    while (!visited[idx(here)]) {
      visited[idx(here)] = true;
      const std::int32_t entered = half_edges.twin[idx(leaving)];
      corner[here] = name;
      // The corner where the walk began has its new name already when the walk comes back.
      const std::int32_t origin = corner[entered];
      const bool starts_here = origin == vertex || (entered == start && origin == name);
      here = starts_here ? entered : next_half_edge(entered);
      leaving = starts_here ? previous_half_edge(entered) : here;
    }
  }
  surface.positions.conservativeResize(vertices + static_cast<Eigen::Index>(original.size()), 3);
  for (std::size_t i = 0; i < original.size(); ++i) {
    surface.positions.row(vertices + static_cast<Eigen::Index>(i)) =
        surface.positions.row(original[i]);
  }
  return static_cast<std::int64_t>(original.size());
}

Orientation orient(const Triangles& triangles, const HalfEdges& half_edges) {
  const std::int32_t* const corner = triangles.data();
  const auto faces = static_cast<std::int32_t>(triangles.rows());
  Orientation result;
  result.component_of_face.assign(idx(faces), -1);
  result.turn.assign(idx(faces), false);
  std::vector<std::int32_t> component;  // its faces, also the queue of the walk
  for (std::int32_t seed = 0; seed < faces; ++seed) {
    if (result.component_of_face[idx(seed)] >= 0) continue;
    component.assign(1, seed);
    result.component_of_face[idx(seed)] = result.components;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::int32_t face = component[i];
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const std::int32_t twin = half_edges.twin[idx(h)];
        const std::int32_t neighbour = twin / 3;
        const bool disagree = corner[h] == corner[twin];
        const bool turn = result.turn[idx(face)] != disagree;
        if (result.component_of_face[idx(neighbour)] < 0) {
          result.component_of_face[idx(neighbour)] = result.components;
          result.turn[idx(neighbour)] = turn;
          turned += turn ? 1 : 0;
          component.push_back(neighbour);
        } else if (result.turn[idx(neighbour)] != turn &&
                   (result.conflict < 0 || h < result.conflict)) {
          result.conflict = h;
        }
      }
    }
    if (2 * turned > component.size()) {
      for (const std::int32_t face : component) result.turn[idx(face)] = !result.turn[idx(face)];
    }
    ++result.components;
  }
  return result;
}

namespace {

constexpr std::size_t sum_grain = 1 << 14;  // faces

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct ComponentBox {
  Eigen::RowVector3d low = Eigen::RowVector3d::Constant(unbounded);
  Eigen::RowVector3d high = Eigen::RowVector3d::Constant(-unbounded);
};

/// Calls add(face, part) for every face, where part is that of the face's component in one of
/// several lists, then join(whole, part) in the order of the faces. The lists depend on the surface
/// alone.
template <typename Part, typename Add, typename Join>
std::vector<Part> for_components(std::size_t faces, const Orientation& orientation, int threads,
                                 const Add& add, const Join& join) {
  struct Run {
    std::int32_t component;
    Part part;
  };
  std::vector<std::vector<Run>> lists((faces + sum_grain - 1) / sum_grain);
  parallel_for(faces, sum_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Run> runs;
    for (std::size_t f = begin; f < end; ++f) {
      const std::int32_t component = orientation.component_of_face[f];
      if (runs.empty() || runs.back().component != component) runs.push_back({component, {}});
      add(static_cast<std::int32_t>(f), runs.back().part);
    }
    lists[begin / sum_grain] = std::move(runs);
  });
  std::vector<Part> whole(idx(orientation.components));
  for (const auto& runs : lists) {
    for (const Run& run : runs) join(whole[idx(run.component)], run.part);
  }
  return whole;
}

}  // namespace

bool ComponentSums::encloses_something() const {
  constexpr double least = 0x1p-24;
  return std::abs(volume) > least * area * std::sqrt(area);
}

std::vector<ComponentSums> component_sums(const Surface& surface, const Orientation& orientation,
                                          int threads) {
  const std::size_t faces = idx(surface.triangles.rows());
  const auto boxes = for_components<ComponentBox>(
      faces, orientation, threads,
      [&](std::int32_t f, ComponentBox& box) {
        for (int k = 0; k < 3; ++k) {
          box.low = box.low.cwiseMin(surface.positions.row(surface.triangles(f, k)));
          box.high = box.high.cwiseMax(surface.positions.row(surface.triangles(f, k)));
        }
      },
      [](ComponentBox& whole, const ComponentBox& part) {
        whole.low = whole.low.cwiseMin(part.low);
        whole.high = whole.high.cwiseMax(part.high);
      });
  return for_components<ComponentSums>(
      faces, orientation, threads,
      [&](std::int32_t f, ComponentSums& sums) {
        if (sums.first_face < 0) sums.first_face = f;
        const ComponentBox& box = boxes[idx(orientation.component_of_face[idx(f)])];
        const double extent = (box.high - box.low).maxCoeff();
        if (!(extent > 0)) return;
        const auto corner = [&](int k) -> Eigen::Vector3d {
          return (surface.positions.row(surface.triangles(f, k)) - box.low).transpose() / extent;
        };
        const Eigen::Vector3d a = corner(0);
        const Eigen::Vector3d b = corner(1);
        const Eigen::Vector3d c = corner(2);
        sums.area += twice_area(a, b, c) / 2;
        sums.volume += a.dot(b.cross(c)) / 6;
      },
      [](ComponentSums& whole, const ComponentSums& part) {
        if (whole.first_face < 0) whole.first_face = part.first_face;
        whole.area += part.area;
        whole.volume += part.volume;
      });
}

}  // namespace curveskel
