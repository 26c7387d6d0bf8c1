#include "skeleton/picture/rasterise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/parallel.hpp"

namespace curveskel {
namespace {

constexpr int samples_across = 3;  // per pixel and direction
constexpr int rows_per_band = 4;   // pixels; one thread draws one band at a time
constexpr float nothing = -std::numeric_limits<float>::infinity();

/// A vertex in samples: x right, y down, z towards the viewer; the normal in the viewer's axes.
struct Corner {
  double x, y;
  float z;
  Eigen::Vector3f normal;
};

/// The surface under one sample.
struct Sample {
  float depth = nothing;  ///< of the front-most point
  float thickness = 0;    ///< depths of the faces towards the viewer minus those away from them
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

std::vector<Corner> corners_of(const Surface& surface, const Positions& normals, const View& view,
                               int threads) {
  constexpr std::size_t grain = 20000;
  std::vector<Corner> corners(static_cast<std::size_t>(surface.positions.rows()));
  parallel_for(corners.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      const Eigen::Vector3d seen = view.project(surface.positions.row(row));
      corners[v] = {seen.x() * samples_across, seen.y() * samples_across,
                    static_cast<float>(seen.z() * samples_across),
                    (view.axes * normals.row(row).transpose()).cast<float>()};
    }
  });
  return corners;
}

/// Sets the corners relative to the part of the picture that they touch, and says which.
Fragments move_to_window(std::vector<Corner>& corners, int width, int height) {
  double left = width;
  double right = 0;
  double top = height;
  double bottom = 0;
  for (const Corner& corner : corners) {
    left = std::min(left, corner.x / samples_across);
    right = std::max(right, corner.x / samples_across);
    top = std::min(top, corner.y / samples_across);
    bottom = std::max(bottom, corner.y / samples_across);
  }
  const auto whole = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, 1.0 * most));
  };
  Fragments window;
  window.left = whole(std::floor(left), width);
  window.top = whole(std::floor(top), height);
  window.width = std::max(0, whole(std::ceil(right), width) - window.left);
  window.height = std::max(0, whole(std::ceil(bottom), height) - window.top);
  for (Corner& corner : corners) {
    corner.x -= window.left * samples_across;
    corner.y -= window.top * samples_across;
  }
  return window;
}

/// The triangles that touch each band: those of band b are triangles[first[b]] .. [first[b+1] - 1].
struct PixelBands {
  std::vector<std::size_t> first;
  std::vector<std::int32_t> triangles;
};

PixelBands sort_into_bands(const Surface& surface, const std::vector<Corner>& corners, int height) {
  constexpr double samples_per_band = samples_across * rows_per_band;
  const int bands = (height + rows_per_band - 1) / rows_per_band;
  const auto range_of = [&](Eigen::Index f) {
    std::array<double, 3> y{};
    for (int k = 0; k < 3; ++k) {
      y[static_cast<std::size_t>(k)] =
          corners[static_cast<std::size_t>(surface.triangles(f, k))].y / samples_per_band;
    }
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return std::pair(static_cast<int>(std::clamp(std::floor(*low), 0.0, bands * 1.0)),
                     static_cast<int>(std::clamp(std::floor(*high), -1.0, bands - 1.0)));
  };
  PixelBands result{std::vector<std::size_t>(static_cast<std::size_t>(bands) + 1, 0), {}};
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const auto [low, high] = range_of(f);
    for (int b = low; b <= high; ++b) ++result.first[static_cast<std::size_t>(b) + 1];
  }
  for (std::size_t b = 1; b < result.first.size(); ++b) result.first[b] += result.first[b - 1];
  result.triangles.resize(result.first.back());
  std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const auto [low, high] = range_of(f);
    for (int b = low; b <= high; ++b) {
      result.triangles[next[static_cast<std::size_t>(b)]++] = static_cast<std::int32_t>(f);
    }
  }
  return result;
}

/// The columns [first, second) of pixels that the triangles of a band can touch.
std::pair<int, int> columns_of(const Surface& surface, const std::vector<Corner>& corners,
                               const PixelBands& bands, std::size_t band, int width) {
  double left = width;
  double right = 0;
  for (std::size_t k = bands.first[band]; k < bands.first[band + 1]; ++k) {
    for (const std::int32_t v : surface.triangles.row(bands.triangles[k])) {
      const double x = corners[static_cast<std::size_t>(v)].x / samples_across;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  const auto whole = [width](double value) {
    return static_cast<int>(std::clamp(value, 0.0, 1.0 * width));
  };
  const int first = whole(std::floor(left));
  return {first, std::max(first, whole(std::ceil(right)))};
}

/// The part of the picture from (left, top) on, in samples.
struct SampleRows {
  int left;
  int top;
  int width;
  int height;
  std::vector<Sample> samples;
};

/// The crossing of the row by the edge between two corners: the same for both triangles there, so
/// that no sample is missed or taken twice.
double crossing(const Corner& upper, const Corner& lower, double row) {
  return upper.x + (row - upper.y) * (lower.x - upper.x) / (lower.y - upper.y);
}

void draw_triangle(std::array<const Corner*, 3> corner, SampleRows& rows) {
  const auto& [a, b, c] = corner;
  const double twice_area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
  if (twice_area == 0 || !std::isfinite(twice_area)) return;
  const float facing = twice_area < 0 ? 1.0F : -1.0F;  // y points down
  const Corner origin = *a;
  const double bx = (c->y - a->y) / twice_area;  // gradients of the weights of b and c
  const double by = -(c->x - a->x) / twice_area;
  const double cx = -(b->y - a->y) / twice_area;
  const double cy = (b->x - a->x) / twice_area;
  const Corner& second = *b;
  const Corner& third = *c;

  std::sort(corner.begin(), corner.end(),
            [](const Corner* p, const Corner* q) { return p->y < q->y; });
  const auto& [upper, middle, lower] = corner;
  const auto row_from = [&](double y) {
    return static_cast<int>(
        std::clamp(std::ceil(y - 0.5), 1.0 * rows.top, 1.0 * rows.top + rows.height));
  };
  const int end = row_from(lower->y);
  for (int row = row_from(upper->y); row < end; ++row) {
    const double y = row + 0.5;
    double from = crossing(*upper, *lower, y);
    double to = y < middle->y ? crossing(*upper, *middle, y) : crossing(*middle, *lower, y);
    if (from > to) std::swap(from, to);
    const auto column_from = [&](double x) {
      return static_cast<int>(
          std::clamp(std::ceil(x - 0.5), 1.0 * rows.left, 1.0 * rows.left + rows.width));
    };
    const int last = column_from(to);
    for (int column = column_from(from); column < last; ++column) {
      const double dx = column + 0.5 - origin.x;
      const double dy = y - origin.y;
      const auto of_b = static_cast<float>(std::clamp(bx * dx + by * dy, 0.0, 1.0));
      const auto of_c = static_cast<float>(std::clamp(cx * dx + cy * dy, 0.0, 1.0));
      const float of_a = 1.0F - of_b - of_c;
      const float depth = of_a * origin.z + of_b * second.z + of_c * third.z;
      auto& sample = rows.samples[static_cast<std::size_t>(row - rows.top) *
                                      static_cast<std::size_t>(rows.width) +
                                  static_cast<std::size_t>(column - rows.left)];
      sample.thickness += facing * depth;
      if (depth <= sample.depth) continue;
      sample.depth = depth;
      sample.normal = of_a * origin.normal + of_b * second.normal + of_c * third.normal;
    }
  }
}

Fragment mean_of(const SampleRows& rows, int x, int y) {
  Fragment fragment;
  for (int j = 0; j < samples_across; ++j) {
    for (int i = 0; i < samples_across; ++i) {
      const auto& sample = rows.samples[static_cast<std::size_t>(y * samples_across + j) *
                                            static_cast<std::size_t>(rows.width) +
                                        static_cast<std::size_t>(x * samples_across + i)];
      if (sample.depth == nothing) continue;
      fragment.coverage += 1;
      fragment.depth += sample.depth;
      fragment.thickness += std::max(0.0F, sample.thickness);
      fragment.normal += sample.normal.normalized();
    }
  }
  if (fragment.coverage > 0) {
    fragment.depth /= fragment.coverage * samples_across;
    fragment.thickness /= fragment.coverage * samples_across;
    fragment.normal /= fragment.coverage;
    fragment.coverage /= samples_across * samples_across;
  }
  return fragment;
}

}  // namespace

Fragments rasterise(const Surface& surface, const Positions& normals, const View& view, int width,
                    int height, int threads) {
  std::vector<Corner> corners = corners_of(surface, normals, view, threads);
  Fragments result = move_to_window(corners, width, height);
  const PixelBands bands = sort_into_bands(surface, corners, result.height);
  const auto columns = static_cast<std::size_t>(result.width);
  result.pixels.resize(columns * static_cast<std::size_t>(result.height));
  parallel_for(bands.first.size() - 1, 1, threads, [&](std::size_t band, std::size_t) {
    const int top = static_cast<int>(band) * rows_per_band;
    const int bottom = std::min(result.height, top + rows_per_band);
    const auto [left, right] = columns_of(surface, corners, bands, band, result.width);
    SampleRows rows{left * samples_across,
                    top * samples_across,
                    (right - left) * samples_across,
                    (bottom - top) * samples_across,
                    {}};
    rows.samples.resize(static_cast<std::size_t>(rows.width) *
                        static_cast<std::size_t>(rows.height));
    for (std::size_t k = bands.first[band]; k < bands.first[band + 1]; ++k) {
      const auto triangle = surface.triangles.row(bands.triangles[k]);
      draw_triangle({&corners[static_cast<std::size_t>(triangle(0))],
                     &corners[static_cast<std::size_t>(triangle(1))],
                     &corners[static_cast<std::size_t>(triangle(2))]},
                    rows);
    }
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        result.pixels[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)] =
            mean_of(rows, x - left, y - top);
      }
    }
  });
  return result;
}

}  // namespace curveskel
