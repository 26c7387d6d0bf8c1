// Surfaces as CGAL's half-edge meshes, and back. For sources that include CGAL.
#pragma once

#include <CGAL/boost/graph/iterator.h>

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// `Mesh` is a CGAL::Surface_mesh; vertices and faces keep their numbers. Precondition: an oriented
/// manifold.
template <typename Mesh>
[[nodiscard]] Mesh cgal_mesh(const Surface& surface) {
  using Vertex = typename Mesh::Vertex_index;
  Mesh mesh;
  for (const auto& p : surface.positions.rowwise()) {
    mesh.add_vertex(typename Mesh::Point(p.x(), p.y(), p.z()));
  }
  const auto vertex = [](std::int32_t v) { return Vertex(static_cast<std::uint32_t>(v)); };
  for (const auto& t : surface.triangles.rowwise()) {
    mesh.add_face(vertex(t(0)), vertex(t(1)), vertex(t(2)));
  }
  return mesh;
}

/// Without what was removed from the mesh. Precondition: triangles alone.
template <typename Mesh>
[[nodiscard]] Surface surface_of_cgal(const Mesh& mesh) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  std::vector<std::int32_t> number(mesh.num_vertices(), -1);
  std::int32_t vertices = 0;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    surface.positions.row(vertices) << p.x(), p.y(), p.z();
    number[v.idx()] = vertices++;
  }
  Eigen::Index faces = 0;
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      surface.triangles(faces, k++) = number[v.idx()];
    }
    ++faces;
  }
  return surface;
}

}  // namespace curveskel
