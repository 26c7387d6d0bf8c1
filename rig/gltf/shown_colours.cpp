#include "rig/gltf/shown_colours.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

void show_colours(DressedMesh& mesh, const std::vector<bool>& is_pictured) {
  const auto has_picture = [&](std::size_t face) {
    const int material = mesh.material_of_face[face];
    return material >= 0 && is_pictured[idx(material)];
  };
  bool has_both = false;
  for (std::size_t face = 0; face < mesh.material_of_face.size() && !has_both; ++face) {
    has_both = has_picture(face) &&
               std::any_of(mesh.corners.begin() + mesh.offsets[face],
                           mesh.corners.begin() + mesh.offsets[face + 1],
                           [](const DressedCorner& corner) { return corner.colour >= 0; });
  }
  if (!has_both) return;
  const std::vector<ColourRow> given = std::exchange(mesh.colours, {});
  for (DressedPart& part : mesh.parts) {
    if (part.colour_sets.empty()) continue;
    // At the front; GCC 12 warns of a null pointer in std::vector's insert here.
    part.colour_sets.emplace_back(shown_colours);
    std::rotate(part.colour_sets.begin(), part.colour_sets.end() - 1, part.colour_sets.end());
    part.colour_sets.resize(std::min(part.colour_sets.size(), most_sets));
  }
  std::map<std::pair<std::int32_t, bool>, std::int32_t> rows;
  for (std::size_t face = 0; face < mesh.material_of_face.size(); ++face) {
    const bool is_white = has_picture(face);
    for (auto c = mesh.offsets[face]; c < mesh.offsets[face + 1]; ++c) {
      std::int32_t& colour = mesh.corners[idx(c)].colour;
      if (colour < 0) continue;
      const auto [entry, is_new] =
          rows.try_emplace({colour, is_white}, static_cast<std::int32_t>(mesh.colours.size()));
      if (is_new) {
        ColourRow made = given[idx(colour)];
        std::shift_right(made.begin(), made.end(), 4);
        if (is_white) std::fill_n(made.begin(), 4, 1.0F);
        mesh.colours.push_back(made);
      }
      colour = entry->second;
    }
  }
}

}  // namespace curveskel
