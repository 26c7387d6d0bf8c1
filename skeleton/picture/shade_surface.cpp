#include "skeleton/picture/shade_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "skeleton/picture/rasterise.hpp"

namespace curveskel {
namespace {

/// Light from a wide sky, the brightest at the upper left, in 0..1.
float light_on(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f sun = Eigen::Vector3f(-0.45F, 0.65F, 0.62F).normalized();
  constexpr float wrap = 0.5F;
  return std::max(0.0F, (normal.dot(sun) + wrap) / (1.0F + wrap));
}

/// Running mean over `radius` values to either side, along one direction of the grid.
void box_blur(std::vector<float>& values, std::size_t lines, std::size_t line_step,
              std::size_t count, std::size_t step, std::size_t radius) {
  std::vector<float> line(count);
  for (std::size_t l = 0; l < lines; ++l) {
    float* begin = values.data() + l * line_step;
    for (std::size_t i = 0; i < count; ++i) line[i] = begin[i * step];
    double sum = 0;
    for (std::size_t i = 0; i < std::min(radius, count); ++i) sum += static_cast<double>(line[i]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i + radius < count) sum += static_cast<double>(line[i + radius]);
      if (i > radius) sum -= static_cast<double>(line[i - radius - 1]);
      begin[i * step] = static_cast<float>(sum / static_cast<double>(2 * radius + 1));
    }
  }
}

/// Three box blurs are close to a Gaussian.
void blur(std::vector<float>& values, int width, int height, int radius) {
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  for (int round = 0; round < 3; ++round) {
    box_blur(values, rows, columns, columns, 1, static_cast<std::size_t>(radius));
    box_blur(values, columns, 1, rows, columns, static_cast<std::size_t>(radius));
  }
}

/// The distance of each pixel behind its surroundings, in units of the blur's radius; 0 outside.
std::vector<float> hollows(const Fragments& fragments, int radius) {
  const std::vector<Fragment>& pixels = fragments.pixels;
  std::vector<float> weight(pixels.size());
  std::vector<float> depth(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    weight[i] = pixels[i].coverage;
    depth[i] = pixels[i].coverage * pixels[i].depth;
  }
  blur(weight, fragments.width, fragments.height, radius);
  blur(depth, fragments.width, fragments.height, radius);
  constexpr float least_weight = 1e-4F;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const bool there = pixels[i].coverage > 0 && weight[i] > least_weight;
    depth[i] = there ? (depth[i] / weight[i] - pixels[i].depth) / static_cast<float>(radius) : 0.0F;
  }
  return depth;
}

/// `thickness` is relative to the picture's shorter side.
Colour colour_of(const Eigen::Vector3f& normal, float thickness, float hollow) {
  const Colour bright(0.965F, 0.975F, 0.985F);
  const Colour dark(0.60F, 0.68F, 0.77F);
  const Colour ink(0.30F, 0.38F, 0.49F);
  constexpr float usual_thickness = 0.3F;
  Colour colour = dark + (bright - dark) * (0.25F + 0.75F * light_on(normal));
  colour += (dark - colour) * 0.25F * (1 - std::exp(-thickness / usual_thickness));
  const float turned = 1 - std::max(0.0F, normal.z());
  const float outline = 0.55F * turned * turned + 0.17F * std::clamp(hollow, 0.0F, 2.0F);
  colour += (ink - colour) * std::min(0.65F, outline);
  return colour;
}

}  // namespace

void shade_surface(const Surface& surface, const Positions& normals, const View& view, int threads,
                   Image& image) {
  const Fragments fragments = rasterise(surface, normals, view, image.width, image.height, threads);
  const int side = std::min(image.width, image.height);
  const std::vector<float> hollow = hollows(fragments, std::max(1, side / 90));
  std::size_t i = 0;
  for (int y = 0; y < fragments.height; ++y) {
    for (int x = 0; x < fragments.width; ++x, ++i) {
      const Fragment& fragment = fragments.pixels[i];
      if (fragment.coverage <= 0) continue;
      const Colour colour =
          colour_of(fragment.normal, fragment.thickness / static_cast<float>(side), hollow[i]);
      Colour& below = image.at(fragments.left + x, fragments.top + y);
      below += (colour - below) * fragment.coverage;
    }
  }
}

}  // namespace curveskel
