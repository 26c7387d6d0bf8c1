// Texture coordinates, normals and colours of the corners of a COLLADA mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "surface/read/dae_document.hpp"
#include "surface/read/dae_mesh.hpp"

namespace curveskel {

/// Numbers of a row: those that it must have, and those that are read.
struct DaeColumns {
  std::size_t least;
  std::size_t most;
};

/// Rows of numbers, one for each corner or vertex.
class DaeLayer {
 public:
  /// A source of fewer columns has no rows. Throws Error(Fault::input) with the line where numbers
  /// are broken.
  DaeLayer(const DaeDocument& document, const DaeInput& input, const DaeColumns& columns);

  [[nodiscard]] std::size_t set() const { return set_; }
  /// -1 = none.
  [[nodiscard]] std::int64_t row_of(const DaePrimitive& primitive, std::int32_t tuple) const;
  /// 1 in columns that the source does not have, as colours have no opacity.
  [[nodiscard]] double value(std::size_t row, std::size_t column) const {
    return column < width_ ? values_[width_ * row + column] : 1;
  }

 private:
  std::size_t width_;
  std::size_t offset_;  ///< within a tuple
  std::size_t set_;
  std::vector<double> values_;
};

/// Those of semantic "TEXCOORD" and so on, by their sets: of the primitive, or where it has none of
/// its vertices; `most_sets` at most.
[[nodiscard]] std::vector<DaeLayer> dae_layers(const DaeDocument& document, const DaeMesh& mesh,
                                               const DaePrimitive& primitive,
                                               std::string_view semantic,
                                               const DaeColumns& columns);

}  // namespace curveskel
