#include "rig/plan/body_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "rig/plan/human_proportions.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// Of most of the values, which are at least one.
std::pair<double, double> range_of_most(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t left_out = values.size() / 40;
  return {values[left_out], values[values.size() - 1 - left_out]};
}

}  // namespace

double BodySection::depth_within(double z) const {
  const double margin = 0.25 * (front - rear);
  return std::clamp(z, rear + margin, front - margin);
}

BodySections::BodySections(const CurveTree& tree, const std::vector<char>& is_limb) : tree_(tree) {
  const bool has_limbs = std::find(is_limb.begin(), is_limb.end(), 1) != is_limb.end();
  for (const Vector3d& point : tree.spread) {
    if (has_limbs && is_limb[idx(nearest_ball(tree, tree.own_nodes, point))] != 0) continue;
    points_.push_back(point);
  }
}

BodySection BodySections::at(double y) const {
  constexpr std::size_t least = 16;
  constexpr double thin = 0.01;  // of the height, at first
  std::vector<double> x;
  std::vector<double> z;
  for (double reach = thin; reach < 2 && x.size() < least; reach *= 2) {
    x.clear();
    z.clear();
    for (const Vector3d& p : points_) {
      if (std::abs(p.y() - y) > reach * tree_.height) continue;
      x.push_back(p.x());
      z.push_back(p.z());
    }
  }
  if (x.empty()) return {tree_.middle, tree_.middle, 0, 0};
  const auto [right, left] = range_of_most(x);
  const auto [rear, front] = range_of_most(z);
  return {right, left, rear, front};
}

std::optional<double> BodySections::neck() const {
  // Than the neck, at least.
  constexpr double wider_head = 1.2;
  constexpr double wider_shoulders = 1.6;
  constexpr int steps = 100;  // of the height
  constexpr int hips = 50;
  constexpr int waist = 65;  // lies lower
  std::vector<double> widths;
  const auto height_of = [&](int step) { return tree_.ground + tree_.height * step / steps; };
  for (int k = hips; k <= steps; ++k) widths.push_back(at(height_of(k)).width());
  std::optional<double> neck;
  double least = std::numeric_limits<double>::infinity();
  for (int k = waist; k < steps; ++k) {
    const auto own = widths.begin() + (k - hips);
    const double below = *std::max_element(widths.begin(), own);
    const double above = *std::max_element(own + 1, widths.end());
    if (*own >= least || below < wider_shoulders * *own || above < wider_head * *own) continue;
    least = *own;
    neck = height_of(k);
  }
  return neck;
}

Vector3d BodySections::outermost() const {
  const auto is_right = [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); };
  const auto [right, left] = std::minmax_element(points_.begin(), points_.end(), is_right);
  Vector3d image = *right;
  image.x() = 2 * tree_.middle - image.x();
  return 0.5 * (*left + image);
}

/// x and z, each the median: an arm that is held out on one side moves it less than the box.
Eigen::Vector2d BodySections::middle_of_most(double y) const {
  constexpr double thick = 0.03;  // of the height
  std::vector<double> x;
  std::vector<double> z;
  for (const Vector3d& p : points_) {
    if (std::abs(p.y() - y) > thick * tree_.height) continue;
    x.push_back(p.x());
    z.push_back(p.z());
  }
  if (x.empty()) return at(y).middle();
  return {median_of(std::move(x)), median_of(std::move(z))};
}

double BodySections::lean() const {
  const double shoulders = shoulders_of_height * tree_.height;
  const double hips = hips_of_shoulders * shoulders;
  const double off =
      (middle_of_most(tree_.ground + shoulders) - middle_of_most(tree_.ground + hips)).norm();
  return std::atan2(off, shoulders - hips) * 180 / std::numbers::pi;
}

double BodySections::mirror_plane() const {
  constexpr double lowest = 0.5;  // of the height; up to the chin
  constexpr int steps = 8;
  std::vector<double> middles;
  for (int k = 0; k <= steps; ++k) {
    const double share = lowest + (chin_of_height - lowest) * k / steps;
    middles.push_back(middle_of_most(tree_.ground + share * tree_.height).x());
  }
  return median_of(std::move(middles));
}

}  // namespace curveskel
