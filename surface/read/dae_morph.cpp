#include "surface/read/dae_morph.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace curveskel {
namespace {

/// By target; none where the file gives none.
std::vector<double> weights_of(const DaeDocument& document, const XmlElement& targets) {
  const XmlElement* source = document.input(targets, "MORPH_WEIGHT").source;
  return source == nullptr ? std::vector<double>() : document.rows(*source, 1);
}

double weight_at(const std::vector<double>& weights, std::size_t target) {
  return target < weights.size() && std::isfinite(weights[target]) ? weights[target] : 0;
}

}  // namespace

std::vector<DaeShape> dae_shapes(const DaeDocument& document, const XmlElement& morph,
                                 const DaeMesh& base) {
  std::vector<DaeShape> shapes;
  const XmlElement* targets = morph.child("targets");
  const XmlElement* source =
      targets == nullptr ? nullptr : document.input(*targets, "MORPH_TARGET").source;
  if (source == nullptr) return shapes;
  const std::vector<double> weights = weights_of(document, *targets);
  const bool is_relative = morph.attribute("method") == "RELATIVE";
  bool are_ids = false;
  const std::vector<std::string> ids = document.names(*source, "morph targets", are_ids);
  for (std::size_t target = 0; target < ids.size(); ++target) {
    const XmlElement* geometry = document.find(ids[target]);
    if (geometry == nullptr || geometry->name != "geometry") continue;
    Positions moves = read_dae_mesh(document, *geometry).polygons.positions;
    if (moves.rows() != base.polygons.positions.rows()) continue;
    if (!is_relative) moves -= base.polygons.positions;
    shapes.push_back({std::string(geometry->attribute("name", ids[target])),
                      weight_at(weights, target), std::move(moves)});
  }
  return shapes;
}

bool is_morphed(const DaeDocument& document, const XmlElement& morph) {
  const XmlElement* targets = morph.child("targets");
  if (targets == nullptr) return false;
  const std::vector<double> weights = weights_of(document, *targets);
  return std::ranges::any_of(weights, [](double w) { return std::isfinite(w) && w != 0; });
}

}  // namespace curveskel
