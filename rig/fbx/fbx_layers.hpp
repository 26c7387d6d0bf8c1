// Texture coordinates, normals and materials of the corners of an FBX mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// A corner of a polygon of an FBX geometry.
struct FbxCorner {
  std::size_t corner = 0;  ///< of all of the geometry, in the file's order
  std::size_t vertex = 0;
  std::size_t polygon = 0;
};

/// The layers of a geometry with that name, as "LayerElementUV", in the file's order; `most_sets`
/// at most.
[[nodiscard]] std::vector<const FbxRecord*> fbx_sets(const FbxRecord& geometry,
                                                     std::string_view name);

/// A layer: rows of numbers, one for each corner, vertex, polygon, or for all.
class FbxLayer {
 public:
  /// `record` as "LayerElementUV", `values` as "UV", `indices` as "UVIndex". Without a record, or
  /// with one that is given in another way, no corner has a row. Throws Error(Fault::input) where
  /// numbers are broken.
  FbxLayer(const FileBytes& file, const FbxRecord* record, std::string_view values,
           std::string_view indices, std::size_t width);

  [[nodiscard]] std::size_t rows() const { return values_.size() / width_; }
  [[nodiscard]] double value(std::size_t row, std::size_t column) const {
    return values_[width_ * row + column];
  }
  /// -1 = none.
  [[nodiscard]] std::int64_t row_of(const FbxCorner& corner) const;

 private:
  enum class Given { nowhere, by_corner, by_vertex, by_polygon, for_all };

  Given given_ = Given::nowhere;
  std::size_t width_;
  std::vector<double> values_;
  std::vector<double> indices_;
  bool is_indexed_ = false;
};

}  // namespace curveskel
