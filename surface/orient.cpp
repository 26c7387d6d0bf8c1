#include "surface/orient.hpp"

#include "surface/element_index.hpp"

#include <Eigen/Geometry>
#include <cstddef>

namespace curveskel {
std::int64_t split_umbrellas(Surface& surface, const HalfEdges& half_edges) {
  std::int32_t* const corner = surface.triangles.data();
  const auto corners = static_cast<std::int32_t>(surface.triangles.size());
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  std::vector<bool> visited(at(corners), false);
  std::vector<bool> taken(at(vertices), false);
  std::vector<std::int32_t> original;  // per copy
  for (std::int32_t start = 0; start < corners; ++start) {
    if (visited[at(start)]) continue;
    const std::int32_t vertex = corner[start];
    std::int32_t name = vertex;
    if (taken[at(vertex)]) {
      name = vertices + static_cast<std::int32_t>(original.size());
      original.push_back(vertex);
    }
    taken[at(vertex)] = true;
    // Leave each face by the edge at this corner that we did not come in by. The faces may still
    // be oriented either way.
    std::int32_t here = start;
    std::int32_t leaving = start;
    while (!visited[at(here)]) {
      visited[at(here)] = true;
      const std::int32_t entered = half_edges.twin[at(leaving)];
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
  result.component_of_face.assign(at(faces), -1);
  result.turn.assign(at(faces), false);
  std::vector<std::int32_t> component;  // its faces, also the queue of the walk
  for (std::int32_t seed = 0; seed < faces; ++seed) {
    if (result.component_of_face[at(seed)] >= 0) continue;
    component.assign(1, seed);
    result.component_of_face[at(seed)] = result.components;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::int32_t face = component[i];
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const std::int32_t twin = half_edges.twin[at(h)];
        const std::int32_t neighbour = twin / 3;
        const bool disagree = corner[h] == corner[twin];
        const bool turn = result.turn[at(face)] != disagree;
        if (result.component_of_face[at(neighbour)] < 0) {
          result.component_of_face[at(neighbour)] = result.components;
          result.turn[at(neighbour)] = turn;
          turned += turn ? 1 : 0;
          component.push_back(neighbour);
        } else if (result.turn[at(neighbour)] != turn &&
                   (result.conflict < 0 || h < result.conflict)) {
          result.conflict = h;
        }
      }
    }
    if (2 * turned > component.size()) {
      for (const std::int32_t face : component) result.turn[at(face)] = !result.turn[at(face)];
    }
    ++result.components;
  }
  return result;
}

std::vector<ComponentSums> component_sums(const Surface& surface, const Orientation& orientation) {
  struct Box {
    Eigen::RowVector3d low;
    Eigen::RowVector3d high;
  };
  std::vector<ComponentSums> sums(at(orientation.components));
  std::vector<Box> boxes(sums.size());
  const auto faces = static_cast<std::int32_t>(surface.triangles.rows());
  for (std::int32_t f = 0; f < faces; ++f) {
    const std::size_t component = at(orientation.component_of_face[at(f)]);
    Box& box = boxes[component];
    if (sums[component].first_face < 0) {
      sums[component].first_face = f;
      box.low = box.high = surface.positions.row(surface.triangles(f, 0));
    }
    for (int k = 0; k < 3; ++k) {
      box.low = box.low.cwiseMin(surface.positions.row(surface.triangles(f, k)));
      box.high = box.high.cwiseMax(surface.positions.row(surface.triangles(f, k)));
    }
  }
  for (std::int32_t f = 0; f < faces; ++f) {
    const std::size_t component = at(orientation.component_of_face[at(f)]);
    const Box& box = boxes[component];
    const double extent = (box.high - box.low).maxCoeff();
    if (!(extent > 0)) continue;
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return (surface.positions.row(surface.triangles(f, k)) - box.low).transpose() / extent;
    };
    const Eigen::Vector3d a = corner(0);
    const Eigen::Vector3d b = corner(1);
    const Eigen::Vector3d c = corner(2);
    sums[component].area += (b - a).cross(c - a).norm() / 2;
    sums[component].volume += a.dot(b.cross(c)) / 6;
  }
  return sums;
}

}  // namespace curveskel
