#include "surface/write/write_om.hpp"

// The order matters: what is written is chosen by templates that MeshIO.hh declares.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <sstream>

#include <curveskel/error.hpp>
#include "surface/mesh/silence_openmesh.hpp"

namespace curveskel {

std::string format_om(const Surface& surface) {
  silence_openmesh();
  OpenMesh::TriMesh mesh;
  const auto vertices = static_cast<std::size_t>(surface.positions.rows());
  const auto faces = static_cast<std::size_t>(surface.triangles.rows());
  mesh.reserve(vertices, 3 * faces / 2, faces);
  for (const auto& p : surface.positions.rowwise()) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const auto corner = surface.triangles.row(f);
    const bool is_triangle =
        corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0];
    const auto vertex = [&](int k) { return OpenMesh::VertexHandle(corner[k]); };
    if (is_triangle && mesh.add_face(vertex(0), vertex(1), vertex(2)).is_valid()) continue;
    throw Error(Fault::output,
                "found a face, number " + std::to_string(f) + " counted from 0, that " +
                    (is_triangle ? "meets others in no 2-manifold" : "has a corner twice") +
                    ", needed an oriented 2-manifold to write it as om; write obj, off, ply or stl "
                    "instead, or repair the surface first");
  }
  std::ostringstream bytes;
  if (!OpenMesh::IO::write_mesh(mesh, bytes, ".OM", OpenMesh::IO::Options::Binary)) {
    throw Error(Fault::output, "OpenMesh could not write the surface as om; write ply instead");
  }
  return std::move(bytes).str();
}

}  // namespace curveskel
