#include "skeleton/picture/rasterise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

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
PictureWindow move_to_window(std::vector<Corner>& corners, int width, int height) {
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
  PictureWindow window;
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

/// The surface under the samples of a part of the picture, from (left, top) on, row by row. Each
/// quantity has an array of its own, so that several samples are taken at a time.
struct SampleRows {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<float> depth;      ///< of the front-most point
  std::vector<float> thickness;  ///< depths of the faces towards the viewer minus those away
  std::array<std::vector<float>, 3> normal;

  void clear(int from_left, int from_top, int columns, int rows) {
    left = from_left;
    top = from_top;
    width = columns;
    height = rows;
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    depth.assign(count, nothing);
    thickness.assign(count, 0);
    for (std::vector<float>& coordinate : normal) coordinate.assign(count, 0);
  }

  /// Those on the surface: as long as 1.
  void normalise() {
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const float square =
          normal[0][i] * normal[0][i] + normal[1][i] * normal[1][i] + normal[2][i] * normal[2][i];
      const float over = square > 0 ? 1 / std::sqrt(square) : 0;
      for (std::vector<float>& coordinate : normal) coordinate[i] *= over;
    }
  }
};

/// A row's part of a triangle: the weights of its second and third corner at the first sample, and
/// their steps from one sample to the next.
struct Span {
  std::size_t first;
  int count;
  float b;
  float c;
  float b_step;
  float c_step;
};

void draw_span(const std::array<const Corner*, 3>& corner, const Span& span, float facing,
               SampleRows& rows) {
  const Corner origin = *corner[0];
  const Corner second = *corner[1];
  const Corner third = *corner[2];
  float* const depth_of = rows.depth.data() + span.first;
  float* const thickness_of = rows.thickness.data() + span.first;
  float* const x_of = rows.normal[0].data() + span.first;
  float* const y_of = rows.normal[1].data() + span.first;
  float* const z_of = rows.normal[2].data() + span.first;
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (int i = 0; i < span.count; ++i) {
    const float b_free = span.b + span.b_step * static_cast<float>(i);
    const float c_free = span.c + span.c_step * static_cast<float>(i);
    const float b_low = b_free < 0.0F ? 0.0F : b_free;
    const float c_low = c_free < 0.0F ? 0.0F : c_free;
    const float b = b_low < 1.0F ? b_low : 1.0F;
    const float c = c_low < 1.0F ? c_low : 1.0F;
    const float a = 1.0F - b - c;
    const float depth = a * origin.z + b * second.z + c * third.z;
    const float x = a * origin.normal.x() + b * second.normal.x() + c * third.normal.x();
    const float y = a * origin.normal.y() + b * second.normal.y() + c * third.normal.y();
    const float z = a * origin.normal.z() + b * second.normal.z() + c * third.normal.z();
    const bool in_front = depth > depth_of[i];
    thickness_of[i] += facing * depth;
    x_of[i] = in_front ? x : x_of[i];
    y_of[i] = in_front ? y : y_of[i];
    z_of[i] = in_front ? z : z_of[i];
    depth_of[i] = in_front ? depth : depth_of[i];
  }
}

/// The crossing of the row by the edge between two corners: the same for both triangles there, so
/// that no sample is missed or taken twice.
double crossing(const Corner& upper, const Corner& lower, double row) {
  return upper.x + (row - upper.y) * (lower.x - upper.x) / (lower.y - upper.y);
}

void draw_triangle(const std::array<const Corner*, 3>& given, SampleRows& rows) {
  const auto& [a, b, c] = given;
  const double twice_area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
  if (twice_area == 0 || !std::isfinite(twice_area)) return;
  const float facing = twice_area < 0 ? 1.0F : -1.0F;  // y points down
  const double bx = (c->y - a->y) / twice_area;        // gradients of the weights of b and c
  const double by = -(c->x - a->x) / twice_area;
  const double cx = -(b->y - a->y) / twice_area;
  const double cy = (b->x - a->x) / twice_area;

  std::array<const Corner*, 3> corner = given;
  std::sort(corner.begin(), corner.end(),
            [](const Corner* p, const Corner* q) { return p->y < q->y; });
  const auto& [upper, middle, lower] = corner;
  // The first sample whose middle is beyond `place`; the same for both triangles at an edge.
  const auto sample_from = [](double place, int begin, int count) {
    return static_cast<int>(std::lround(std::clamp(place, 1.0 * begin, 1.0 * (begin + count))));
  };
  const auto row_from = [&](double y) { return sample_from(y, rows.top, rows.height); };
  const int end = row_from(lower->y);
  for (int row = row_from(upper->y); row < end; ++row) {
    const double y = row + 0.5;
    double from = crossing(*upper, *lower, y);
    double to = y <= middle->y ? crossing(*upper, *middle, y) : crossing(*middle, *lower, y);
    if (from > to) std::swap(from, to);
    const int first = sample_from(from, rows.left, rows.width);
    const double dx = first + 0.5 - a->x;
    const double dy = y - a->y;
    draw_span(
        given,
        {static_cast<std::size_t>(row - rows.top) * static_cast<std::size_t>(rows.width) +
             static_cast<std::size_t>(first - rows.left),
         sample_from(to, rows.left, rows.width) - first, static_cast<float>(bx * dx + by * dy),
         static_cast<float>(cx * dx + cy * dy), static_cast<float>(bx), static_cast<float>(cx)},
        facing, rows);
  }
}

Fragment mean_of(const SampleRows& rows, int x, int y) {
  Fragment fragment;
  for (int j = 0; j < samples_across; ++j) {
    for (int i = 0; i < samples_across; ++i) {
      const std::size_t sample =
          static_cast<std::size_t>(y * samples_across + j) * static_cast<std::size_t>(rows.width) +
          static_cast<std::size_t>(x * samples_across + i);
      if (rows.depth[sample] == nothing) continue;
      fragment.coverage += 1;
      fragment.depth += rows.depth[sample];
      fragment.thickness += std::max(0.0F, rows.thickness[sample]);
      fragment.normal +=
          Eigen::Vector3f(rows.normal[0][sample], rows.normal[1][sample], rows.normal[2][sample]);
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

/// Corners and triangles in the order in which they are drawn.
struct Prepared {
  const Surface& surface;
  std::vector<Corner> corners;
  PictureWindow window;
  PixelBands bands;

  /// `rows` and `fragments` are room that is used again.
  void draw_band(std::size_t band, SampleRows& rows, std::vector<Fragment>& fragments,
                 const std::function<void(const FragmentRow&)>& draw_row) const {
    const int top = static_cast<int>(band) * rows_per_band;
    const int bottom = std::min(window.height, top + rows_per_band);
    const auto [left, right] = columns_of(surface, corners, bands, band, window.width);
    rows.clear(left * samples_across, top * samples_across, (right - left) * samples_across,
               (bottom - top) * samples_across);
    for (std::size_t k = bands.first[band]; k < bands.first[band + 1]; ++k) {
      const auto triangle = surface.triangles.row(bands.triangles[k]);
      draw_triangle({&corners[static_cast<std::size_t>(triangle(0))],
                     &corners[static_cast<std::size_t>(triangle(1))],
                     &corners[static_cast<std::size_t>(triangle(2))]},
                    rows);
    }
    rows.normalise();
    fragments.resize(static_cast<std::size_t>(right - left));
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        fragments[static_cast<std::size_t>(x - left)] = mean_of(rows, x - left, y - top);
      }
      draw_row({left, y, fragments});
    }
  }
};

}  // namespace

void rasterise(const Surface& surface, const Positions& normals, const View& view,
               const PictureSize& size, int threads, const FragmentSink& sink) {
  constexpr std::size_t bands_at_a_time = 8;
  Prepared prepared{surface, corners_of(surface, normals, view, threads), {}, {}};
  prepared.window = move_to_window(prepared.corners, size.width, size.height);
  prepared.bands = sort_into_bands(surface, prepared.corners, prepared.window.height);
  sink.begin(prepared.window);
  parallel_for(prepared.bands.first.size() - 1, bands_at_a_time, threads,
               [&](std::size_t first, std::size_t last) {
                 SampleRows rows;
                 std::vector<Fragment> fragments;
                 for (std::size_t band = first; band < last; ++band) {
                   prepared.draw_band(band, rows, fragments, sink.draw);
                 }
               });
}

}  // namespace curveskel
