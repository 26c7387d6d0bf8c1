// A mesh with its materials and pictures as a glTF file.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/mesh_polygons.hpp"
#include "surface/read/file_bytes.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

struct DressedDocument {
  GltfDocument document;
  std::vector<GltfPart> parts;
  std::vector<int> row_of_vertex;      ///< of each vertex written the vertex of the file
  std::vector<MeshPolygons> polygons;  ///< by mesh
  std::vector<int> node_of_part;       ///< of the file's parts; -1 = left out
};

/// A node with a mesh for each part, of a file without parts one named `name`; a primitive for each
/// material, in their order. All of a mesh share its vertices: first those of the file, in its
/// order, then copies for corners that meet in a vertex with other texture coordinates, normals or
/// colours. Corners without a normal get that of `normals_across_seams`.
/// Faces are triangulated; one with a vertex that has no place is left out. Of colours see
/// `show_colours`. Throws Error(Fault::output) where single precision does not do.
[[nodiscard]] DressedDocument dressed_document(DressedMesh mesh,
                                               const std::vector<DressedMaterial>& materials,
                                               const FileBytes& file, const std::string& name,
                                               std::vector<std::string>& notes,
                                               const Monitor& monitor);

}  // namespace curveskel
