#include "skeleton/picture/marks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/graph.hpp>

namespace curveskel {
namespace {

const Colour near_colour(0.80F, 0.05F, 0.16F);
const Colour far_colour(0.86F, 0.45F, 0.46F);
const Colour junction_colour(0.09F, 0.15F, 0.33F);
const Colour tip_colour(0.98F, 0.66F, 0.10F);
const Colour white(1, 1, 1);
constexpr double near_width = 6.5;
constexpr double far_width = 4.3;
constexpr double casing = 1.6;  // of the paper's colour, on either side
constexpr double junction_width = 13.5;
constexpr double tip_width = 12;

struct Layer {
  double depth;
  std::vector<Mark> marks;
};

Mark dot(const Eigen::Vector3d& at, double width, const Colour& colour) {
  return {at.head<2>(), at.head<2>(), width, width, colour, false};
}

/// Distance from the point to the mark's middle line over the half width there: how many pixels the
/// point is outside.
double outside_by(const Mark& mark, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = mark.to - mark.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? (point - mark.from).dot(along) / length2 : 0;
  const double clamped = std::clamp(t, 0.0, 1.0);
  const double half = (mark.from_width + (mark.to_width - mark.from_width) * clamped) / 2;
  const double beside = (point - mark.from - clamped * along).norm() - half;
  if (!mark.flat_ends) return beside;
  const double length = std::sqrt(length2);
  return std::max({beside, -t * length, (t - 1) * length});
}

}  // namespace

std::vector<Mark> marks_of(const CurveSkeleton& skeleton, const View& view, double unit) {
  std::vector<Eigen::Vector3d> seen;
  seen.reserve(static_cast<std::size_t>(skeleton.nodes.rows()));
  double nearest = -std::numeric_limits<double>::infinity();
  double farthest = std::numeric_limits<double>::infinity();
  for (const auto& node : skeleton.nodes.rowwise()) {
    seen.push_back(view.project(node));
    nearest = std::max(nearest, seen.back().z());
    farthest = std::min(farthest, seen.back().z());
  }
  const double range = std::max(nearest - farthest, 1e-9);
  const auto nearness = [&](double z) { return std::clamp((z - farthest) / range, 0.0, 1.0); };
  const auto width = [&](double z) {
    return unit * (far_width + (near_width - far_width) * nearness(z));
  };

  std::vector<Layer> layers;
  std::vector<double> nearest_end(seen.size(), -std::numeric_limits<double>::infinity());
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  for (const auto& edge : skeleton.edges.rowwise()) {
    const Eigen::Vector3d& a = seen[static_cast<std::size_t>(edge(0))];
    const Eigen::Vector3d& b = seen[static_cast<std::size_t>(edge(1))];
    const double depth = (a.z() + b.z()) / 2;
    for (const int node : edge) {
      double& end = nearest_end[static_cast<std::size_t>(node)];
      end = std::max(end, depth);
    }
    const Colour colour =
        far_colour + (near_colour - far_colour) * static_cast<float>(nearness(depth));
    Mark stroke{a.head<2>(), b.head<2>(), width(a.z()), width(b.z()), colour, false};
    Mark around = stroke;
    around.from_width += 2 * casing * unit;
    around.to_width += 2 * casing * unit;
    around.colour = white;
    around.flat_ends = true;
    layers.push_back({depth, {around, stroke}});
  }
  for (std::size_t node = 0; node < seen.size(); ++node) {
    if (degree[node] == 2) continue;
    const bool junction = degree[node] > 2;
    const double size =
        unit * (junction ? junction_width : tip_width) * (0.8 + 0.2 * nearness(seen[node].z()));
    layers.push_back(
        {std::max(seen[node].z() + size, nearest_end[node]),  // over the edges that end here
         {dot(seen[node], size, white),
          dot(seen[node], size - 2 * casing * unit, junction ? junction_colour : tip_colour)}});
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const Layer& a, const Layer& b) { return a.depth < b.depth; });
  std::vector<Mark> marks;
  for (const Layer& layer : layers) {
    marks.insert(marks.end(), layer.marks.begin(), layer.marks.end());
  }
  return marks;
}

void draw_marks(const std::vector<Mark>& marks, Image& image) {
  for (const Mark& mark : marks) {
    const double reach = std::max(mark.from_width, mark.to_width) / 2 + 1;
    const Eigen::Vector2d low = mark.from.cwiseMin(mark.to).array() - reach;
    const Eigen::Vector2d high = mark.from.cwiseMax(mark.to).array() + reach;
    const auto column = [&](double x) {
      return static_cast<int>(std::clamp(x, 0.0, 1.0 * image.width()));
    };
    const auto row = [&](double y) {
      return static_cast<int>(std::clamp(y, 0.0, 1.0 * image.height()));
    };
    for (int y = row(low.y()); y < row(high.y() + 1); ++y) {
      for (int x = column(low.x()); x < column(high.x() + 1); ++x) {
        const double outside = outside_by(mark, {x + 0.5, y + 0.5});
        const auto coverage = static_cast<float>(std::clamp(0.5 - outside, 0.0, 1.0));
        if (coverage > 0) image.blend(x, y, mark.colour, coverage);
      }
    }
  }
}

}  // namespace curveskel
