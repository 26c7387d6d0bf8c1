#include "skeleton/picture/shade_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "skeleton/picture/rasterise.hpp"

namespace curveskel {
namespace {

/// Light from a wide sky, the brightest at the upper left, in 0..1.
float light_on(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f sun = Eigen::Vector3f(-0.45F, 0.65F, 0.62F).normalized();
  constexpr float wrap = 0.5F;
  return std::max(0.0F, (normal.dot(sun) + wrap) / (1.0F + wrap));
}

/// Running means over `radius` values to either side of each, along lines of `count` values that
/// lie `step` apart; `lines` of them lie `line_step` apart. Side by side, so that columns are taken
/// as many at a time as a line of the cache holds.
void box_blur(float* values, std::size_t lines, std::size_t line_step, std::size_t count,
              std::size_t step, std::size_t radius) {
  std::vector<float> given(count * lines);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t l = 0; l < lines; ++l) given[i * lines + l] = values[i * step + l * line_step];
  }
  std::vector<double> sum(lines, 0);
  for (std::size_t i = 0; i < std::min(radius, count); ++i) {
    for (std::size_t l = 0; l < lines; ++l) sum[l] += static_cast<double>(given[i * lines + l]);
  }
  const double size = static_cast<double>(2 * radius + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const float* const ahead = i + radius < count ? given.data() + (i + radius) * lines : nullptr;
    const float* const behind = i > radius ? given.data() + (i - radius - 1) * lines : nullptr;
    for (std::size_t l = 0; l < lines; ++l) {
      if (ahead != nullptr) sum[l] += static_cast<double>(ahead[l]);
      if (behind != nullptr) sum[l] -= static_cast<double>(behind[l]);
      values[i * step + l * line_step] = static_cast<float>(sum[l] / size);
    }
  }
}

/// Three box blurs are close to a Gaussian.
void blur(std::vector<float>& values, int width, int height, int radius, int threads) {
  constexpr std::size_t side_by_side = 16;
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  const auto reach = static_cast<std::size_t>(radius);
  for (int round = 0; round < 3; ++round) {
    parallel_for(rows, side_by_side, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        box_blur(values.data() + y * columns, 1, columns, columns, 1, reach);
      }
    });
    parallel_for(columns, side_by_side, threads, [&](std::size_t begin, std::size_t end) {
      box_blur(values.data() + begin, end - begin, 1, rows, columns, reach);
    });
  }
}

/// The distance of each pixel behind its surroundings, in units of the blur's radius; 0 outside.
std::vector<float> hollows(const Fragments& fragments, int radius, int threads) {
  const std::vector<Fragment>& pixels = fragments.pixels;
  std::vector<float> weight(pixels.size());
  std::vector<float> depth(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    weight[i] = pixels[i].coverage;
    depth[i] = pixels[i].coverage * pixels[i].depth;
  }
  blur(weight, fragments.width, fragments.height, radius, threads);
  blur(depth, fragments.width, fragments.height, radius, threads);
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
  const std::vector<float> hollow = hollows(fragments, std::max(1, side / 90), threads);
  constexpr std::size_t rows_at_a_time = 16;
  const auto columns = static_cast<std::size_t>(fragments.width);
  const auto rows = static_cast<std::size_t>(fragments.height);
  parallel_for(rows, rows_at_a_time, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * columns; i < end * columns; ++i) {
      const Fragment& fragment = fragments.pixels[i];
      if (fragment.coverage <= 0) continue;
      const Colour colour =
          colour_of(fragment.normal, fragment.thickness / static_cast<float>(side), hollow[i]);
      Colour& below = image.at(fragments.left + static_cast<int>(i % columns),
                               fragments.top + static_cast<int>(i / columns));
      below += (colour - below) * fragment.coverage;
    }
  });
}

}  // namespace curveskel
