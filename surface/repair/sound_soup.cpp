#include "surface/repair/sound_soup.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

#include <curveskel/error.hpp>

namespace curveskel {

void require_sound(const PolygonSoup& soup) {
  const auto refuse = [&](const std::string& found, const std::string& needed) {
    const std::string file = soup.file.empty() ? "surface" : soup.file.string();
    throw Error(Fault::input, file + ": found " + found + ", needed " + needed);
  };
  const auto vertices = soup.positions.rows();
  const auto wrong = std::find_if(soup.corners.begin(), soup.corners.end(),
                                  [&](auto corner) { return corner < 0 || corner >= vertices; });
  if (wrong != soup.corners.end()) {
    refuse("corner " + std::to_string(*wrong),
           "corners that are vertices, 0.." + std::to_string(vertices - 1));
  }
  const auto corners = static_cast<std::int64_t>(soup.corners.size());
  if (soup.offsets.empty() && corners == 0) return;
  const bool lead_through = !soup.offsets.empty() && soup.offsets.front() == 0 &&
                            soup.offsets.back() == corners &&
                            std::is_sorted(soup.offsets.begin(), soup.offsets.end());
  if (!lead_through) {
    refuse("offsets of polygons that skip corners",
           "offsets that rise from 0 to " + std::to_string(corners));
  }
}

}  // namespace curveskel
