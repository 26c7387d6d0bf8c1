#include "surface/read/dae_skin.hpp"

#include <cmath>

namespace curveskel {
namespace {

constexpr std::size_t matrix_size = 16;

void read_joints(const DaeDocument& document, const XmlElement& skin, DaeSkin& result) {
  const XmlElement* joints = skin.child("joints");
  if (joints == nullptr) document.fail(skin, "a skin without <joints>", "some");
  const XmlElement* names = document.input(*joints, "JOINT").source;
  const XmlElement* binds = document.input(*joints, "INV_BIND_MATRIX").source;
  if (names == nullptr || binds == nullptr) {
    document.fail(*joints, "joints without names or matrices", "both");
  }
  result.joints = document.names(*names, "joints", result.joints_are_ids);
  const std::vector<double> matrices = document.rows(*binds, matrix_size);
  if (matrices.size() != matrix_size * result.joints.size()) {
    document.fail(*joints, std::to_string(matrices.size() / matrix_size) + " matrices",
                  "one for each of the " + std::to_string(result.joints.size()) + " joints");
  }
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const double* numbers = matrices.data() + matrix_size * j;
    result.inverse_bind.push_back(document.matrix(*binds, numbers));
  }
}

/// A pair of <v> counts for a vertex; joint -1 stands for the bind shape, which no joint moves.
void read_weights(const DaeDocument& document, const XmlElement& skin, std::size_t vertices,
                  DaeSkin& result) {
  const XmlElement* weights = skin.child("vertex_weights");
  const XmlElement* counts = weights == nullptr ? nullptr : weights->child("vcount");
  const XmlElement* pairs = weights == nullptr ? nullptr : weights->child("v");
  if (counts == nullptr || pairs == nullptr) return;  // it moves nothing
  const DaeInput joint = document.input(*weights, "JOINT");
  const DaeInput weight = document.input(*weights, "WEIGHT");
  if (joint.source == nullptr || weight.source == nullptr) {
    document.fail(*weights, "weights without joints or numbers", "both");
  }
  const std::vector<double> values = document.rows(*weight.source, 1);
  const std::vector<double> all = document.numbers(*pairs);
  const std::size_t stride = document.indices_per_corner(*weights);
  const auto index_at = [&](std::size_t at, std::size_t end) {
    if (!(all[at] >= 0 && all[at] < static_cast<double>(end) && std::floor(all[at]) == all[at])) {
      document.fail(*pairs, "the index " + std::to_string(all[at]) + " of a joint or weight",
                    "a whole number from 0 to " + std::to_string(end) + " - 1");
    }
    return static_cast<std::size_t>(all[at]);
  };
  std::size_t at = 0;
  std::size_t vertex = 0;
  for (const std::size_t count : document.indices(*counts, all.size() / stride + 1)) {
    if (vertex >= vertices || stride * count > all.size() - at) {
      document.fail(*weights, "weights of more vertices or joints than there are", "as many");
    }
    for (std::size_t i = 0; i < count; ++i, at += stride) {
      if (all[at + joint.offset] == -1) continue;
      const double value = values[index_at(at + weight.offset, values.size())];
      if (!std::isfinite(value)) document.fail(*weights, "a weight that is no number", "numbers");
      result.weights.push_back({vertex, index_at(at + joint.offset, result.joints.size()), value});
    }
    ++vertex;
  }
}

}  // namespace

DaeSkin read_dae_skin(const DaeDocument& document, const XmlElement& skin, std::size_t vertices) {
  DaeSkin result;
  result.bind_shape.setIdentity();
  if (const XmlElement* shape = skin.child("bind_shape_matrix")) {
    const std::vector<double> numbers = document.numbers(*shape);
    if (numbers.size() != matrix_size) document.fail(*shape, "no matrix", "sixteen numbers");
    result.bind_shape = document.matrix(*shape, numbers.data());
  }
  read_joints(document, skin, result);
  read_weights(document, skin, vertices, result);
  return result;
}

}  // namespace curveskel
