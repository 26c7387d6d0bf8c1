#include "surface/repair/sound_soup.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

#include <curveskel/error.hpp>

namespace curveskel {

void require_sound(const PolygonSoup& soup) {
  require_sound_polygons(soup.positions.rows(), soup.corners, soup.offsets,
                         soup.file.empty() ? "surface" : soup.file.string());
}

void require_polygons(const PolygonSoup& soup) {
  if (!soup.offsets.empty()) return;
  throw Error(Fault::input, (soup.file.empty() ? "surface" : soup.file.string()) +
                                ": found no polygons, needed a closed surface");
}

void require_sound_polygons(Eigen::Index vertices, const std::vector<std::int32_t>& all_corners,
                            const std::vector<std::int64_t>& offsets, std::string_view purpose) {
  const auto refuse = [&](const std::string& found, const std::string& needed) {
    throw Error(Fault::input, std::string(purpose) + ": found " + found + ", needed " + needed);
  };
  const auto wrong = std::find_if(all_corners.begin(), all_corners.end(),
                                  [&](auto corner) { return corner < 0 || corner >= vertices; });
  if (wrong != all_corners.end()) {
    refuse("corner " + std::to_string(*wrong),
           "corners that are vertices, 0.." + std::to_string(vertices - 1));
  }
  const auto corners = static_cast<std::int64_t>(all_corners.size());
  if (offsets.empty() && corners == 0) return;  // as PolygonSoup{} is
  const bool lead_through = !offsets.empty() && offsets.front() == 0 && offsets.back() == corners &&
                            std::is_sorted(offsets.begin(), offsets.end());
  if (!lead_through) {
    refuse("offsets of polygons that skip corners",
           "offsets that rise from 0 to " + std::to_string(corners));
  }
}

}  // namespace curveskel
