#include "surface/read/dae_morph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
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

/// Without its mark, "#".
std::string_view id_in(std::string_view reference) {
  return reference.starts_with('#') ? reference.substr(1) : reference;
}

/// Controllers that are shown, or are the source of others.
void note_controllers(const XmlElement& element, std::set<std::string_view>& ids) {
  if (element.name == "instance_controller") ids.insert(id_in(element.attribute("url")));
  if (element.name == "skin" || element.name == "morph") {
    ids.insert(id_in(element.attribute("source")));
  }
  for (const XmlElement& child : element.children) note_controllers(child, ids);
}

}  // namespace

std::map<const XmlElement*, const XmlElement*> loose_dae_morphs(const DaeDocument& document) {
  std::set<std::string_view> used;
  note_controllers(document.root(), used);
  std::map<const XmlElement*, const XmlElement*> morphs;
  for (const XmlElement* library : document.root().all("library_controllers")) {
    for (const XmlElement* controller : library->all("controller")) {
      const XmlElement* morph = controller->child("morph");
      if (morph == nullptr || used.contains(controller->attribute("id"))) continue;
      morphs.emplace(document.find(id_in(morph->attribute("source"))), morph);
    }
  }
  return morphs;
}

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
