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

unsigned char as_byte(float share) {
  constexpr float to_nearest = 0.5F;  // std::lround is a call for each of millions
  return static_cast<unsigned char>(std::clamp(share, 0.0F, 1.0F) * 255.0F + to_nearest);
}

/// All that the shading needs of the window's pixels once they are drawn.
struct DepthBuffer {
  DepthBuffer() = default;
  explicit DepthBuffer(const PictureWindow& touched)
      : window(touched),
        columns(static_cast<std::size_t>(touched.width)),
        depth(columns * static_cast<std::size_t>(touched.height), 0.0F),
        coverage(depth.size(), 0),
        outline(depth.size(), 0) {}

  void keep(int x, int y, const Fragment& fragment) {
    const std::size_t i = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
    const float turned = 1 - std::max(0.0F, fragment.normal.z());
    depth[i] = fragment.depth;
    coverage[i] = as_byte(fragment.coverage);
    outline[i] = as_byte(0.55F * turned * turned);
  }

  PictureWindow window;
  std::size_t columns = 0;
  std::vector<float> depth;
  std::vector<unsigned char> coverage;  // in 255ths
  std::vector<unsigned char> outline;   // share of the ink there, in 255ths
};

/// The means of depths over the surroundings, at half the picture's resolution: wide as they are,
/// they need no more.
class Surroundings {
 public:
  Surroundings(const DepthBuffer& buffer, int radius, int threads)
      : columns_((buffer.columns + 1) / 2) {
    const std::size_t rows = buffer.columns > 0 ? buffer.depth.size() / buffer.columns : 0;
    const std::size_t half_rows = (rows + 1) / 2;
    weight_.assign(columns_ * half_rows, 0.0F);
    depth_.assign(columns_ * half_rows, 0.0F);
    for (std::size_t y = 0; y < rows; ++y) {
      for (std::size_t x = 0; x < buffer.columns; ++x) {
        const std::size_t i = y * buffer.columns + x;
        if (buffer.coverage[i] == 0) continue;
        const float covered = static_cast<float>(buffer.coverage[i]) / 255.0F;
        weight_[y / 2 * columns_ + x / 2] += covered;
        depth_[y / 2 * columns_ + x / 2] += covered * buffer.depth[i];
      }
    }
    const int half = std::max(1, radius / 2);
    blur(weight_, static_cast<int>(columns_), static_cast<int>(half_rows), half, threads);
    blur(depth_, static_cast<int>(columns_), static_cast<int>(half_rows), half, threads);
  }

  /// `otherwise` where there are none.
  [[nodiscard]] float depth_at(std::size_t x, std::size_t y, float otherwise) const {
    constexpr float least_weight = 1e-4F;
    const std::size_t i = y / 2 * columns_ + x / 2;
    return weight_[i] > least_weight ? depth_[i] / weight_[i] : otherwise;
  }

 private:
  std::size_t columns_;
  std::vector<float> weight_;
  std::vector<float> depth_;
};

const Colour paper(1, 1, 1);
const Colour ink(0.30F, 0.38F, 0.49F);
constexpr float most_ink = 0.65F;

/// Without ink; `thickness` is relative to the picture's shorter side.
Colour colour_of(const Eigen::Vector3f& normal, float thickness) {
  const Colour bright(0.965F, 0.975F, 0.985F);
  const Colour dark(0.60F, 0.68F, 0.77F);
  constexpr float usual_thickness = 0.3F;
  const Colour colour = dark + (bright - dark) * (0.25F + 0.75F * light_on(normal));
  return colour + (dark - colour) * 0.25F * (1 - std::exp(-thickness / usual_thickness));
}

/// Outlines and hollows over colours that are there.
void draw_ink(const DepthBuffer& buffer, int radius, int threads, Image& image) {
  const Surroundings surroundings(buffer, radius, threads);
  constexpr std::size_t rows_at_a_time = 16;
  const auto rows = static_cast<std::size_t>(buffer.window.height);
  parallel_for(rows, rows_at_a_time, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < buffer.columns; ++x) {
        const std::size_t i = y * buffer.columns + x;
        if (buffer.coverage[i] == 0) continue;
        const float depth = buffer.depth[i];
        const float hollow =
            (surroundings.depth_at(x, y, depth) - depth) / static_cast<float>(radius);
        const float outline =
            static_cast<float>(buffer.outline[i]) / 255.0F + 0.17F * std::clamp(hollow, 0.0F, 2.0F);
        const float covered = static_cast<float>(buffer.coverage[i]) / 255.0F;
        image.blend(buffer.window.left + static_cast<int>(x),
                    buffer.window.top + static_cast<int>(y), paper + (ink - paper) * covered,
                    std::min(most_ink, outline));
      }
    }
  });
}

}  // namespace

void shade_surface(const Surface& surface, const Positions& normals, const View& view, int threads,
                   Image& image) {
  const auto side = static_cast<float>(std::min(image.width(), image.height()));
  DepthBuffer buffer;
  const auto draw_row = [&](const FragmentRow& row) {
    for (std::size_t k = 0; k < row.pixels.size(); ++k) {
      const Fragment& fragment = row.pixels[k];
      if (fragment.coverage <= 0) continue;
      const int x = row.left + static_cast<int>(k);
      buffer.keep(x, row.y, fragment);
      image.blend(buffer.window.left + x, buffer.window.top + row.y,
                  colour_of(fragment.normal, fragment.thickness / side), fragment.coverage);
    }
  };
  rasterise(surface, normals, view, {image.width(), image.height()}, threads,
            {[&](const PictureWindow& window) { buffer = DepthBuffer(window); }, draw_row});
  draw_ink(buffer, std::max(1, static_cast<int>(side) / 90), threads, image);
}

}  // namespace curveskel
