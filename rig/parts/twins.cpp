#include "rig/parts/twins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// Areas in an order, of which a stretch that has none below another is skipped at once.
class OrderedAreas {
 public:
  explicit OrderedAreas(std::vector<double> areas)
      : areas_(std::move(areas)),
        width_(1 + static_cast<std::size_t>(std::sqrt(double(areas_.size())))) {
    for (std::size_t at = 0; at < areas_.size(); ++at) {
      if (at % width_ == 0) least_.push_back(areas_[at]);
      least_.back() = std::min(least_.back(), areas_[at]);
    }
  }

  [[nodiscard]] double at(std::size_t place) const { return areas_[place]; }

  /// The first place from `place` on with an area below `least`, or one past all.
  [[nodiscard]] std::size_t first_below(double least, std::size_t place) const {
    while (place < areas_.size() && !(areas_[place] < least)) {
      ++place;
      while (place % width_ == 0 && place < areas_.size() && !(least_[place / width_] < least)) {
        place = std::min(place + width_, areas_.size());
      }
    }
    return place;
  }

 private:
  std::vector<double> areas_;
  std::size_t width_;
  std::vector<double> least_;  // of each stretch of this width
};

/// Ranks of points in cells a little wider than a tolerance.
class RanksInCells {
 public:
  explicit RanksInCells(double tolerance) : side_(tolerance > 0 ? (1 + rounding) * tolerance : 1) {}

  void add(const Vector3d& point, std::size_t rank) { cells_[cell_of(point)].push_back(rank); }

  /// The first rank of from..end - 1 near the point that fits; `end` if none does. What `is_gone`
  /// need not fit again.
  template <typename IsGone, typename Fits>
  [[nodiscard]] std::size_t first_near(const Vector3d& point, std::size_t from, std::size_t end,
                                       const IsGone& is_gone, const Fits& fits) {
    const Cell middle = cell_of(point);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
      if (found == cells_.end()) continue;
      auto& [ranks, begin] = found->second;
      while (begin < ranks.size() && (ranks[begin] < from || is_gone(ranks[begin]))) ++begin;
      for (std::size_t place = begin; place < ranks.size() && ranks[place] < end; ++place) {
        if (!is_gone(ranks[place]) && fits(ranks[place])) end = ranks[place];
      }
    }
    return end;
  }

 private:
  static constexpr double rounding = 0.01;
  using Cell = std::array<std::int64_t, 3>;

  struct Ranks {
    std::vector<std::size_t> all;  // ascending
    std::size_t begin = 0;         // of those that may still fit

    void push_back(std::size_t rank) { all.push_back(rank); }
  };

  [[nodiscard]] Cell cell_of(const Vector3d& point) const {
    const auto along = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(point[axis] / side_));
    };
    return {along(0), along(1), along(2)};
  }

  double side_;
  std::map<Cell, Ranks> cells_;
};

std::vector<int> twins_through(const MeasuredComponents& components, int axis, double plane,
                               double tolerance, const std::stop_token& stop) {
  constexpr double least_alike = 0.97;  // areas
  const auto& middles = components.middles;
  const auto& by_area = components.by_area;
  std::vector<double> in_order;
  RanksInCells cells(tolerance);
  for (const int c : by_area) {
    cells.add(middles[idx(c)], in_order.size());
    in_order.push_back(components.areas[idx(c)]);
  }
  const OrderedAreas ordered(std::move(in_order));
  std::vector<int> twins(middles.size(), -1);
  const auto is_paired = [&](std::size_t rank) { return twins[idx(by_area[rank])] >= 0; };
  for (std::size_t rank = 0; rank < by_area.size(); ++rank) {
    throw_if_stopped(stop);
    if (is_paired(rank)) continue;
    const std::size_t c = idx(by_area[rank]);
    Vector3d image = middles[c];
    image[axis] = 2 * plane - image[axis];
    if ((image - middles[c]).norm() < tolerance) continue;
    const std::size_t end = ordered.first_below(least_alike * ordered.at(rank), rank + 1);
    const std::size_t found =
        cells.first_near(image, rank + 1, end, is_paired, [&](std::size_t other) {
          return (middles[idx(by_area[other])] - image).norm() <= tolerance;
        });
    if (found == end) continue;
    twins[c] = by_area[found];
    twins[idx(by_area[found])] = by_area[rank];
  }
  return twins;
}

}  // namespace

std::vector<int> mirrored_twins(const MeasuredComponents& components, const Vector3d& middle,
                                double tolerance, const std::stop_token& stop) {
  std::vector<int> best(components.middles.size(), -1);
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> twins = twins_through(components, axis, middle[axis], tolerance, stop);
    double paired = 0;
    for (std::size_t c = 0; c < twins.size(); ++c) {
      paired += twins[c] >= 0 ? components.areas[c] : 0;
    }
    if (paired <= most) continue;
    most = paired;
    best = std::move(twins);
  }
  return best;
}

}  // namespace curveskel
