// Laws of the colours, by a CIELAB of the test's own.
#include "viewer/render/colours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curveskel::viewer::colours_laws {
namespace {

/// CIE 1976 L*a*b* of an sRGB colour, white D65.
glm::dvec3 lab_of(const glm::vec3& colour) {
  glm::dvec3 linear;
  for (int i = 0; i < 3; ++i) {
    const double value = static_cast<double>(colour[i]);
    linear[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  const glm::dvec3 xyz(0.4124564 * linear.r + 0.3575761 * linear.g + 0.1804375 * linear.b,
                       0.2126729 * linear.r + 0.7151522 * linear.g + 0.0721750 * linear.b,
                       0.0193339 * linear.r + 0.1191920 * linear.g + 0.9503041 * linear.b);
  const auto root = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const glm::dvec3 f(root(xyz.x / 0.95047), root(xyz.y), root(xyz.z / 1.08883));
  return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

double lightness(const glm::vec3& colour) { return lab_of(colour).x; }

TEST(LabOfTheTest, KnowsWhiteAndMiddleGrey) {
  EXPECT_NEAR(lightness(glm::vec3(1)), 100, 1e-3);
  EXPECT_NEAR(lightness(glm::vec3(119 / 255.0F)), 50, 0.1);
  EXPECT_NEAR(lab_of({1, 0, 0}).y, 80.1, 0.1);
}

TEST(ColourMap, GrowsLighterAllAlong) {
  constexpr int steps = 1000;
  for (const auto& map : colour_maps) {
    double before = lightness(mapped(map.value, 0));
    for (int i = 1; i <= steps; ++i) {
      const double now = lightness(mapped(map.value, static_cast<float>(i) / steps));
      EXPECT_GT(now, before) << map.name << " at " << i;
      before = now;
    }
  }
}

TEST(ColourMap, GrowsLighterEvenly) {
  constexpr int steps = 20;
  for (const auto& map : colour_maps) {
    const double first = lightness(mapped(map.value, 0));
    const double whole = lightness(mapped(map.value, 1)) - first;
    EXPECT_GT(whole, 60) << map.name;
    for (int i = 1; i < steps; ++i) {
      const float value = static_cast<float>(i) / steps;
      const double share = (lightness(mapped(map.value, value)) - first) / whole;
      // They are even in CAM02-UCS; magma strays furthest from L*, by 0.056.
      EXPECT_NEAR(share, static_cast<double>(value), 0.07) << map.name;
    }
  }
}

TEST(ColourMap, IsClamped) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (const auto& map : colour_maps) {
    for (const float below : {-infinite, -1e30F, -1.0F, -1e-6F}) {
      EXPECT_EQ(mapped(map.value, below), mapped(map.value, 0)) << map.name;
    }
    for (const float above : {infinite, 1e30F, 2.0F, 1.00001F}) {
      EXPECT_EQ(mapped(map.value, above), mapped(map.value, 1)) << map.name;
    }
  }
}

TEST(ColourMap, ShowsNoNumberAsGrey) {
  for (const auto& map : colour_maps) {
    const glm::vec3 grey = mapped(map.value, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(grey.r, grey.g);
    EXPECT_EQ(grey.g, grey.b);
  }
}

TEST(Category, NeighboursDifferClearly) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 50; ++i) {
    for (std::size_t apart = 1; apart <= 3; ++apart) {
      const double distance = glm::distance(lab_of(category(i)), lab_of(category(i + apart)));
      least = std::min(least, distance);
    }
  }
  EXPECT_GT(least, 25);  // 30.4; what people call clearly different begins at about 10
}

TEST(Category, TheFirstFewAllDiffer) {
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(glm::distance(lab_of(category(i)), lab_of(category(j))), 15) << i << ", " << j;
    }
  }
}

TEST(Category, AllAreAboutAsLight) {
  double low = 100;
  double high = 0;
  for (std::size_t i = 0; i < 4096; ++i) {
    low = std::min(low, lightness(category(i)));
    high = std::max(high, lightness(category(i)));
  }
  EXPECT_GT(low, 40);
  EXPECT_LT(high - low, 25);
}

TEST(Category, HasAColourForEveryNumber) {
  for (const std::size_t number :
       {std::size_t{1} << 20U, std::numeric_limits<std::size_t>::max()}) {
    const glm::vec3 colour = category(number);
    EXPECT_EQ(glm::clamp(colour, 0.0F, 1.0F), colour);
  }
}

TEST(Rgba, RoundsAndClamps) {
  EXPECT_EQ(rgba({0, 0.5F, 1}), (Rgba{0, 128, 255, 255}));
  EXPECT_EQ(rgba({-3, 7, 1 / 255.0F}, 0), (Rgba{0, 255, 1, 0}));
}

}  // namespace
}  // namespace curveskel::viewer::colours_laws
