// A mesh of a glTF file as FBX has it. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "rig/fbx/fbx_document.hpp"
#include "rig/gltf/mesh_polygons.hpp"
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Rows of numbers, one a vertex or place.
using FbxRows = std::vector<double>;

struct FbxMesh {
  FbxRows places;
  FbxRows normals;            ///< none where a primitive has none
  std::vector<FbxRows> maps;  ///< pairs (u, v), v up
  std::vector<std::string> map_names;
  std::vector<FbxRows> colours;  ///< red, green, blue as sRGB, opacity
  std::vector<std::string> colour_names;
  struct Shape {
    std::string name;
    double weight = 0;
    FbxRows offsets;
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

  [[nodiscard]] bool empty() const { return corners.empty(); }
  [[nodiscard]] bool has_materials() const { return materials != std::vector<int>{-1}; }
};

/// The triangles of all its primitives; vertices that primitives share come once. `joints` is the
/// number of the skin's, `map_names` has one for each set of texture coordinates. Throws
/// Error(Fault::input) where numbers are wrong.
[[nodiscard]] FbxMesh read_fbx_mesh(const FileBytes& file, const tinygltf::Model& model, int mesh,
                                    std::size_t joints, std::vector<std::string> map_names);

/// In place of its triangles. Places, moves and weights are then of places, what a corner has else
/// is of vertices.
void take_polygons(FbxMesh& mesh, const MeshPolygons& polygons);

void move(FbxMesh& mesh, const Eigen::Affine3d& frame);

struct FbxGeometry {
  std::int64_t number = 0;
  std::vector<std::int64_t> sliders;  ///< one of each shape
};

/// The geometry with its shapes; the weights of shapes connect to it.
[[nodiscard]] FbxGeometry add_fbx_geometry(FbxDocument& document, const std::string& name,
                                           FbxMesh mesh);

}  // namespace curveskel
