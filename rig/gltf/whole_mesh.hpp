// A mesh of a glTF file with all its primitives in one, for formats that have it so.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "rig/gltf/mesh_polygons.hpp"
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
struct Mesh;
}  // namespace tinygltf

namespace curveskel {

/// Rows of numbers, one a vertex or place.
using MeshRows = std::vector<double>;

struct WholeMesh {
  MeshRows places;
  MeshRows normals;               ///< none where a primitive has none
  std::vector<MeshRows> maps;     ///< pairs (u, v), v up
  std::vector<MeshRows> colours;  ///< red, green, blue as shares of light, opacity
  struct Shape {
    std::string name;
    double weight = 0;  ///< at rest
    MeshRows offsets;
  };
  std::vector<Shape> shapes;
  std::vector<std::int32_t> corners;  ///< face k has those from offsets[k] on
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> place_of_vertex;        ///< where seams parted vertices; none = its own
  std::vector<std::int32_t> material_of_face;       ///< one of `materials`
  std::vector<std::int32_t> material_of_primitive;  ///< likewise
  std::vector<int> materials;                       ///< of the file; -1 = the file names none
  /// Of each of the skin's joints the vertices that it moves, and their weights.
  std::vector<std::vector<std::pair<std::int32_t, double>>> moved;
  /// Of each vertex the first joint that its row names, be it without weight; -1 = none, of a mesh
  /// without joints no rows.
  std::vector<std::int32_t> first_joint;

  [[nodiscard]] bool empty() const { return corners.empty(); }
  [[nodiscard]] bool has_materials() const { return materials != std::vector<int>{-1}; }
};

/// Numbers of the sets of texture coordinates and of colours that are read, and the first one of
/// colours.
struct MeshSets {
  std::size_t maps = 0;
  std::size_t colours = 0;
  std::size_t first_colours = 0;
};

/// All that the mesh's triangles have.
[[nodiscard]] MeshSets sets_of(const tinygltf::Mesh& mesh);

/// The triangles of all its primitives; vertices that primitives share come once. `joints` is the
/// number of the skin's. Throws Error(Fault::input) where numbers are wrong.
[[nodiscard]] WholeMesh read_whole_mesh(const FileBytes& file, const tinygltf::Model& model,
                                        int mesh, std::size_t joints, const MeshSets& sets);

/// In place of its triangles. Places, moves and weights are then of places, what a corner has else
/// is of vertices.
void take_polygons(WholeMesh& mesh, const MeshPolygons& polygons);

/// Faces that a mirrored frame turns inside out are turned round.
void move(WholeMesh& mesh, const Eigen::Affine3d& frame);

}  // namespace curveskel
