// Texture coordinates, normals and colours of a mesh that is gathered from several.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {

/// Rows are given once each, within a mesh of the file. All answer with the row, -1 = none, as for
/// numbers that are not finite.
class DressedRows {
 public:
  /// It must outlive this.
  explicit DressedRows(DressedMesh& mesh) : mesh_(mesh) {}

  void begin_mesh();
  [[nodiscard]] std::int32_t texture(const TextureRow& row);
  /// Of a vertex of the present mesh; `map` as of `normal_maps`.
  [[nodiscard]] std::int32_t normal(std::size_t vertex, const Eigen::Vector3d& given,
                                    const Eigen::Matrix3d& map);
  [[nodiscard]] std::int32_t colour(const ColourRow& row);

 private:
  DressedMesh& mesh_;
  std::map<TextureRow, std::int32_t> textures_;
  std::map<std::tuple<std::size_t, float, float, float>, std::int32_t> normals_;
  std::map<ColourRow, std::int32_t> colours_;
};

}  // namespace curveskel
