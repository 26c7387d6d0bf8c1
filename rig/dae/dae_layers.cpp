#include "rig/dae/dae_layers.hpp"

#include <algorithm>

#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {

DaeLayer::DaeLayer(const DaeDocument& document, const DaeInput& input, const DaeColumns& columns)
    : width_(columns.most), offset_(input.offset), set_(input.set) {
  const std::size_t given = document.width(*input.source);
  if (given > 0) width_ = std::clamp(given, columns.least, columns.most);
  if (given == 0 || given >= columns.least) values_ = document.rows(*input.source, width_);
}

std::int64_t DaeLayer::row_of(const DaePrimitive& primitive, std::int32_t tuple) const {
  const auto row = static_cast<std::size_t>(
      primitive.indices[static_cast<std::size_t>(tuple) * primitive.stride + offset_]);
  return row < values_.size() / width_ ? static_cast<std::int64_t>(row) : -1;
}

std::vector<DaeLayer> dae_layers(const DaeDocument& document, const DaeMesh& mesh,
                                 const DaePrimitive& primitive, std::string_view semantic,
                                 const DaeColumns& columns) {
  std::vector<DaeInput> inputs = document.inputs(*primitive.element, semantic);
  if (inputs.empty()) {
    inputs = document.inputs(*mesh.vertices, semantic);
    const std::size_t offset = document.input(*primitive.element, "VERTEX").offset;
    for (DaeInput& input : inputs) input.offset = offset;
  }
  std::vector<DaeLayer> layers;
  for (std::size_t set = 0; set < std::min(inputs.size(), most_sets); ++set) {
    layers.emplace_back(document, inputs[set], columns);
  }
  return layers;
}

}  // namespace curveskel
