// The shown part of a glTF scene, and the part of it that a skin moves.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include "surface/read/gltf_numbers.hpp"

namespace tinygltf {
struct Primitive;
}

namespace curveskel {

/// Vertices first_vertex, first_vertex + 1, ... of the soup are those of this primitive.
struct GltfSkinned {
  const tinygltf::Primitive* primitive;
  int skin;
  std::int64_t first_vertex;
};

/// One primitive where the scene shows it. Primitives of one mesh may share their vertices.
struct GltfPart {
  int node;  ///< in a file without nodes the mesh, which then stands for one
  int mesh;
  int primitive;  ///< of the mesh
  bool in_soup;   ///< else points or lines, whose vertices are rows of `loose`
  std::int64_t first_vertex;
  std::int64_t count;
  Eigen::Affine3d move;  ///< from the (morphed) positions in the file to the scene; the identity
                         ///< where joints bend it
  bool bent = false;     ///< no one move takes all of the node's mesh there
};

struct GltfReading {
  bool as_bound = false;    ///< see `ReadOptions`
  bool with_loose = false;  ///< points and lines, too
};

struct GltfScene {
  PolygonSoup soup;
  std::vector<GltfPart> parts;          ///< in the order of the scene
  Positions loose;                      ///< vertices of points and lines, only where asked for
  std::vector<GltfSkinned> skinned;     ///< once per node and accessor of positions
  std::vector<Eigen::Affine3d> frames;  ///< of each node, also of one outside the scene
  std::vector<int> parents;             ///< of each node; -1 = none
  std::vector<int> nodes;               ///< those in the scene, each before its children
};

/// The number of triangles that so many corners are, in a mode of triangles, strips or fans.
[[nodiscard]] std::size_t gltf_triangle_count(int mode, std::size_t corners);

/// The places of a triangle's corners among those of all, in the standard's order.
[[nodiscard]] std::array<std::size_t, 3> gltf_triangle(int mode, std::size_t number);

/// Valid as long as the model. Throws Error(Fault::input) where indices or numbers are wrong.
[[nodiscard]] GltfScene read_gltf_scene(const FileBytes& file, const tinygltf::Model& model,
                                        const Monitor& monitor, const GltfReading& reading = {});

}  // namespace curveskel
