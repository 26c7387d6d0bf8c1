#include "viewer/render/colours.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

glm::vec3 from_oklch(float lightness, float chroma, float hue) {
  const float a = chroma * std::cos(hue);
  const float b = chroma * std::sin(hue);
  const glm::vec3 cones(lightness + 0.3963377774F * a + 0.2158037573F * b,
                        lightness - 0.1055613458F * a - 0.0638541728F * b,
                        lightness - 0.0894841775F * a - 1.2914855480F * b);
  const glm::vec3 lms = cones * cones * cones;
  glm::vec3 linear(4.0767416621F * lms.x - 3.3077115913F * lms.y + 0.2309699292F * lms.z,
                   -1.2684380046F * lms.x + 2.6097574011F * lms.y - 0.3413193965F * lms.z,
                   -0.0041960863F * lms.x - 0.7034186147F * lms.y + 1.7076147010F * lms.z);
  linear = glm::clamp(linear, 0.0F, 1.0F);
  const auto encode = [](float value) {
    return value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1 / 2.4F) - 0.055F;
  };
  return {encode(linear.x), encode(linear.y), encode(linear.z)};
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
  constexpr float golden = 2.39996323F;  // radians: no two of the first few are near each other
  constexpr float first_hue = 0.9F;
  const float hue = std::fmod(first_hue + golden * static_cast<float>(number % 4096),
                              2 * std::numbers::pi_v<float>);
  const float lightness = number % 2 == 0 ? 0.72F : 0.64F;
  return from_oklch(lightness, 0.13F, hue);
}

}  // namespace curveskel::viewer
