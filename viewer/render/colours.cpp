#include "viewer/render/colours.hpp"

#include <algorithm>
#include <cmath>

#include <curveskel/labelled_surface.hpp>

namespace curveskel::viewer {
namespace {

/// 0xRRGGBB at equal steps from 0 to 1.
using Anchors = std::array<std::uint32_t, 10>;
constexpr Anchors viridis_anchors{0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e,
                                  0x1f9e89, 0x35b779, 0x6dcd59, 0xb4de2c, 0xfde725};
constexpr Anchors magma_anchors{0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f,
                                0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf};
constexpr Anchors cividis_anchors{0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173,
                                  0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55, 0xfee838};

const Anchors& anchors_of(ColourMap map) {
  switch (map) {
    case ColourMap::viridis:
      break;
    case ColourMap::magma:
      return magma_anchors;
    case ColourMap::cividis:
      return cividis_anchors;
  }
  return viridis_anchors;
}

glm::vec3 unpacked(std::uint32_t colour) {
  return glm::vec3((colour >> 16U) & 255U, (colour >> 8U) & 255U, colour & 255U) / 255.0F;
}

}  // namespace

Rgba rgba(const glm::vec3& colour, float alpha) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
  };
  return {byte(colour.x), byte(colour.y), byte(colour.z), byte(alpha)};
}

glm::vec3 mapped(ColourMap map, float value) {
  if (std::isnan(value)) return glm::vec3(0.5F);
  const Anchors& anchors = anchors_of(map);
  const float place = std::clamp(value, 0.0F, 1.0F) * static_cast<float>(anchors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  return glm::mix(unpacked(anchors[below]), unpacked(anchors[below + 1]),
                  place - static_cast<float>(below));
}

glm::vec3 category(std::size_t number) {
  const auto [red, green, blue] = branch_colour(static_cast<int>(number));
  return glm::vec3(red, green, blue) / 255.0F;
}

}  // namespace curveskel::viewer
