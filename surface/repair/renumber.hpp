// New numbers for the vertices of a repaired surface: in its map, its rims and its sheets.
#pragma once

#include <algorithm>

#include <curveskel/repair.hpp>

namespace curveskel {

/// `number` gives a vertex of the surface before its number in the surface now, -1 = dropped. Rims
/// and sheets with a vertex that `is_gone` are none any more, even if it has a number: that of the
/// nearest vertex of something else.
template <typename Number, typename IsGone>
void renumber(RepairedSurface& repaired, const Number& number, const IsGone& is_gone) {
  for (int& v : repaired.vertex_of_input) v = v < 0 ? -1 : number(v);
  std::erase_if(repaired.rims,
                [&](const auto& rim) { return std::any_of(rim.begin(), rim.end(), is_gone); });
  std::erase_if(repaired.sheets, is_gone);
  for (auto& rim : repaired.rims) {
    for (std::int32_t& v : rim) v = number(v);
  }
  for (std::int32_t& v : repaired.sheets) v = number(v);
}

}  // namespace curveskel
