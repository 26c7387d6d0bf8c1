// Texture coordinates, normals and colours of a mesh that is gathered from several.
#pragma once

#include <Eigen/Core>
#include <array>
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
  /// Of sRGB, with a linear opacity.
  [[nodiscard]] std::int32_t colour(const std::array<double, 4>& given);

 private:
  DressedMesh& mesh_;
  std::map<TextureRow, std::int32_t> textures_;
  std::map<std::tuple<std::size_t, float, float, float>, std::int32_t> normals_;
  std::map<std::array<double, 4>, std::int32_t> colours_;
};

}  // namespace curveskel
