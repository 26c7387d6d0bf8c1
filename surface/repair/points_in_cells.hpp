// Points of a plane in a grid: those in a triangle are found without looking at all.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace curveskel {

/// About one point per cell.
class PointsInCells {
 public:
  /// The points must outlive the grid.
  explicit PointsInCells(const std::vector<Eigen::Vector2d>& points) : points_(points) {
    low_ = high_ = points.front();
    for (const Eigen::Vector2d& p : points) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    const Eigen::Vector2d extent = high_ - low_;
    const auto count = static_cast<double>(points.size());
    const double columns = std::sqrt(count * extent.x() / extent.y());
    columns_ = columns >= 1 ? static_cast<std::size_t>(std::min(columns, count)) : 1;
    rows_ = std::max<std::size_t>(1, points.size() / columns_);
    per_length_ = {per_length(columns_, extent.x()), per_length(rows_, extent.y())};
    cells_.resize(columns_ * rows_);
    for (std::size_t i = 0; i < points.size(); ++i) cell_of(points[i]).push_back(i);
  }

  void remove(std::size_t point) {
    auto& cell = cell_of(points_[point]);
    cell.erase(std::find(cell.begin(), cell.end(), point));
  }

  /// A point, among them all that lie in the triangle or on its border, for which `wanted` is true.
  template <typename Wanted>
  [[nodiscard]] std::optional<std::size_t> find_in(const std::array<Eigen::Vector2d, 3>& triangle,
                                                   const Wanted& wanted) const {
    const auto [least, greatest] = std::minmax({triangle[0].y(), triangle[1].y(), triangle[2].y()});
    for (std::size_t row = row_of(least); row <= row_of(greatest); ++row) {
      const auto [from, to] = columns_in(row, triangle);
      for (std::size_t column = from; column <= to; ++column) {
        for (const std::size_t point : cells_[row * columns_ + column]) {
          if (wanted(point)) return point;
        }
      }
    }
    return std::nullopt;
  }

 private:
  struct Columns {
    std::size_t from = 0;
    std::size_t to = 0;
  };

  static double per_length(std::size_t cells, double length) {
    const double result = static_cast<double>(cells) / length;
    return std::isfinite(result) ? result : 0;
  }

  static std::size_t cell_at(double place, std::size_t cells) {
    return place > 0 ? static_cast<std::size_t>(std::min(place, double(cells - 1))) : 0;
  }

  [[nodiscard]] std::size_t column_of(double x) const {
    return cell_at((x - low_.x()) * per_length_.x(), columns_);
  }
  [[nodiscard]] std::size_t row_of(double y) const {
    return cell_at((y - low_.y()) * per_length_.y(), rows_);
  }
  std::vector<std::size_t>& cell_of(const Eigen::Vector2d& p) {
    return cells_[row_of(p.y()) * columns_ + column_of(p.x())];
  }

  /// The columns that the triangle reaches in the row, with some room for rounding.
  [[nodiscard]] Columns columns_in(std::size_t row,
                                   const std::array<Eigen::Vector2d, 3>& triangle) const {
    constexpr double rounding = 1e-9;  // of the extent
    const Eigen::Vector2d room = rounding * (high_ - low_);
    if (per_length_.y() == 0) return {0, columns_ - 1};
    const double bottom = low_.y() + double(row) / per_length_.y() - room.y();
    const double top = low_.y() + double(row + 1) / per_length_.y() + room.y();
    double from = high_.x();
    double to = low_.x();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d& a = triangle[k];
      const Eigen::Vector2d way = triangle[(k + 1) % 3] - a;
      double begin = 0;
      double end = 1;
      if (way.y() != 0) {
        const auto [first, last] =
            std::minmax({(bottom - a.y()) / way.y(), (top - a.y()) / way.y()});
        begin = std::max(begin, first);
        end = std::min(end, last);
      } else if (a.y() < bottom || a.y() > top) {
        continue;
      }
      if (begin > end) continue;
      const auto [left, right] = std::minmax({a.x() + begin * way.x(), a.x() + end * way.x()});
      from = std::min(from, left);
      to = std::max(to, right);
    }
    return {column_of(from - room.x()), column_of(to + room.x())};
  }

  const std::vector<Eigen::Vector2d>& points_;
  Eigen::Vector2d low_;
  Eigen::Vector2d high_;
  Eigen::Vector2d per_length_;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;  // row by row
};

}  // namespace curveskel
