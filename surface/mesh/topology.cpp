#include <curveskel/topology.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/error.hpp>

namespace curveskel {

Topology topology(const Surface& surface) {
  require_corners(surface, "topology");
  const Eigen::Index vertex_count = surface.positions.rows();
  const Triangles& triangles = surface.triangles;
  UnionFind sets(vertex_count);
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    sets.unite(triangles(face, 0), triangles(face, 1));
    sets.unite(triangles(face, 1), triangles(face, 2));
  }

  Topology result;
  result.component_of_vertex.resize(vertex_count);
  for (int vertex = 0; vertex < vertex_count; ++vertex) {
    const int root = sets.root(vertex);
    if (root == vertex) {
      result.component_of_vertex(vertex) = static_cast<int>(result.vertices.size());
      result.vertices.push_back(0);
    } else {
      result.component_of_vertex(vertex) = result.component_of_vertex(root);
    }
    ++result.vertices[static_cast<std::size_t>(result.component_of_vertex(vertex))];
  }
  result.faces.assign(result.vertices.size(), 0);
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    ++result.faces[static_cast<std::size_t>(result.component_of_vertex(triangles(face, 0)))];
  }
  result.genus.resize(result.vertices.size());
  for (std::size_t i = 0; i < result.genus.size(); ++i) {
    // On a closed surface 2 E = 3 F, hence chi = V - F / 2.
    result.genus[i] = (2 - result.vertices[i] + result.faces[i] / 2) / 2;
  }
  return result;
}

namespace {

/// True if the topology's numbers and counts are those of this surface.
bool counts_fit(const Surface& surface, const Topology& topology) {
  const int components = topology.components();
  if (topology.component_of_vertex.size() != surface.positions.rows()) return false;
  if (std::ssize(topology.vertices) != components || std::ssize(topology.faces) != components) {
    return false;
  }
  std::vector<int> vertices(topology.vertices.size(), 0);
  for (const int component : topology.component_of_vertex) {
    if (component < 0 || component >= components) return false;
    ++vertices[static_cast<std::size_t>(component)];
  }
  std::vector<int> faces(topology.faces.size(), 0);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const int component = topology.component_of_vertex(surface.triangles(face, 0));
    ++faces[static_cast<std::size_t>(component)];
  }
  return vertices == topology.vertices && faces == topology.faces;
}

}  // namespace

std::vector<Component> split_components(const Surface& surface, const Topology& topology) {
  require_corners(surface, "split_components");
  if (!counts_fit(surface, topology)) {
    throw Error(Fault::input, "split_components: found the topology of " +
                                  std::to_string(topology.component_of_vertex.size()) +
                                  " vertices of another surface, needed that of the surface's " +
                                  std::to_string(surface.positions.rows()));
  }
  std::vector<Component> components(static_cast<std::size_t>(topology.components()));
  if (components.size() == 1) {
    components[0].surface = surface;
    components[0].vertex_in_whole.resize(static_cast<std::size_t>(surface.positions.rows()));
    std::iota(components[0].vertex_in_whole.begin(), components[0].vertex_in_whole.end(), 0);
    return components;
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    components[i].vertex_in_whole.reserve(static_cast<std::size_t>(topology.vertices[i]));
    components[i].surface.positions.resize(topology.vertices[i], 3);
    components[i].surface.triangles.resize(topology.faces[i], 3);
  }
  std::vector<std::int32_t> local(static_cast<std::size_t>(surface.positions.rows()));
  for (int vertex = 0; vertex < surface.positions.rows(); ++vertex) {
    auto& [part, vertex_in_whole] =
        components[static_cast<std::size_t>(topology.component_of_vertex(vertex))];
    const auto index = static_cast<std::int32_t>(vertex_in_whole.size());
    local[static_cast<std::size_t>(vertex)] = index;
    part.positions.row(index) = surface.positions.row(vertex);
    vertex_in_whole.push_back(vertex);
  }
  std::vector<Eigen::Index> filled(components.size(), 0);
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const auto i =
        static_cast<std::size_t>(topology.component_of_vertex(surface.triangles(face, 0)));
    const Eigen::Index row = filled[i]++;
    for (int corner = 0; corner < 3; ++corner) {
      components[i].surface.triangles(row, corner) =
          local[static_cast<std::size_t>(surface.triangles(face, corner))];
    }
  }
  return components;
}

}  // namespace curveskel
