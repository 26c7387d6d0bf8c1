// Texture coordinates, normals and colours of a mesh that is gathered from several.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include <curveskel/read.hpp>
#include "rig/gltf/colours.hpp"
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

  /// The rows that a corner has in the layers of a file: row_in(layer) is -1 = none, and
  /// layer.value(row, column) a number. Of sets of texture coordinates; 0 where one has none.
  template <typename Layer, typename RowIn>
  [[nodiscard]] std::int32_t texture_in(const std::vector<Layer>& sets, const RowIn& row_in) {
    TextureRow made{};
    bool is_there = false;
    for (std::size_t set = 0; set < sets.size(); ++set) {
      const std::int64_t row = row_in(sets[set]);
      if (row < 0) continue;
      is_there = true;
      for (std::size_t k = 0; k < 2; ++k) {
        made[2 * set + k] = static_cast<float>(sets[set].value(static_cast<std::size_t>(row), k));
      }
    }
    return is_there ? texture(made) : -1;
  }
  /// Of sets of colours in sRGB; white where one has none.
  template <typename Layer, typename RowIn>
  [[nodiscard]] std::int32_t colour_in(const std::vector<Layer>& sets, const RowIn& row_in) {
    ColourRow made{};
    bool is_there = false;
    for (std::size_t set = 0; set < sets.size(); ++set) {
      const std::int64_t row = row_in(sets[set]);
      is_there = is_there || row >= 0;
      std::array<double, 4> srgb{1, 1, 1, 1};
      for (std::size_t k = 0; k < 4 && row >= 0; ++k) {
        srgb[k] = sets[set].value(static_cast<std::size_t>(row), k);
      }
      std::ranges::copy(linear_colour(srgb), made.begin() + static_cast<std::ptrdiff_t>(4 * set));
    }
    return is_there ? colour(made) : -1;
  }
  /// Of a layer of normals; `vertex` and `map` as above.
  template <typename Layer, typename RowIn>
  [[nodiscard]] std::int32_t normal_in(const Layer& layer, const RowIn& row_in, std::size_t vertex,
                                       const Eigen::Matrix3d& map) {
    const std::int64_t found = row_in(layer);
    if (found < 0) return -1;
    const auto row = static_cast<std::size_t>(found);
    return normal(vertex, {layer.value(row, 0), layer.value(row, 1), layer.value(row, 2)}, map);
  }

  /// Takes over where vertices are, and which polygons have; the corners are there, in this order.
  /// Without the shares of shapes, which are there and show them again.
  void place(const PolygonSoup& soup);

 private:
  DressedMesh& mesh_;
  std::map<TextureRow, std::int32_t> textures_;
  std::map<std::tuple<std::size_t, float, float, float>, std::int32_t> normals_;
  std::map<ColourRow, std::int32_t> colours_;
};

}  // namespace curveskel
