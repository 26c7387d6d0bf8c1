// Nearest-item search over a sequence whose neighbours lie close together, such as the points along
// a curve: groups of eight, groups of eight groups and so on. Internal to skeleton/.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace curveskel {

class SequenceTree {
 public:
  struct Item {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    double weight = 0;  ///< what the item's value may lie below the distance to its box
  };

  explicit SequenceTree(std::vector<Item> items) {
    levels_.push_back(std::move(items));
    group();
  }

  /// Items whose neighbours may lie anywhere, and the order in which they lie close together: all
  /// their numbers. Values and finds are of the items' own numbers.
  SequenceTree(const std::vector<Item>& items, std::vector<std::int32_t> order)
      : order_(std::move(order)) {
    std::vector<Item>& along = levels_.emplace_back();
    along.reserve(items.size());
    for (const std::int32_t i : order_) along.push_back(items[static_cast<std::size_t>(i)]);
    group();
  }

  /// True if value(i) <= 0 for any item, where value(i) is as in `minimum`.
  template <typename Value>
  [[nodiscard]] bool reaches(const Eigen::Vector3d& p, const Value& value) const {
    double best = std::numeric_limits<double>::min();  // leaves out all above zero
    if (!levels_.front().empty()) visit(levels_.size() - 1, 0, p, 0, value, best);
    return best <= 0;
  }

  /// Calls found(i) once for every item whose box has a point in common with the one from `lower`
  /// to `upper`.
  template <typename Found>
  void overlapping(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                   const Found& found) const {
    if (!levels_.front().empty()) overlap(levels_.size() - 1, 0, lower, upper, found);
  }

  /// The smallest value(i) over all items, where value(i) >= (distance from p to box i) - weight i;
  /// infinity if there are no items. Once a value <= enough is found, any such value may be
  /// returned. Item `first`, if there is such a one, is looked at before all others: a good guess
  /// saves most of the search.
  template <typename Value>
  [[nodiscard]] double minimum(const Eigen::Vector3d& p, double enough, const Value& value,
                               std::size_t first = std::numeric_limits<std::size_t>::max()) const {
    double best =
        first < levels_.front().size() ? value(first) : std::numeric_limits<double>::infinity();
    if (best <= enough) return best;
    if (!levels_.front().empty()) visit(levels_.size() - 1, 0, p, enough, value, best);
    return best;
  }

 private:
  static constexpr std::size_t width = 8;

  [[nodiscard]] std::size_t item_at(std::size_t place) const {
    return order_.empty() ? place : static_cast<std::size_t>(order_[place]);
  }

  void group() {
    while (levels_.back().size() > 1) {
      const std::vector<Item>& below = levels_.back();
      std::vector<Item> groups;
      for (std::size_t i = 0; i < below.size(); ++i) {
        if (i % width == 0) {
          groups.push_back(below[i]);
          continue;
        }
        Item& group = groups.back();
        group.lower = group.lower.cwiseMin(below[i].lower);
        group.upper = group.upper.cwiseMax(below[i].upper);
        group.weight = std::max(group.weight, below[i].weight);
      }
      levels_.push_back(std::move(groups));
    }
  }

  template <typename Found>
  void overlap(std::size_t level, std::size_t index, const Eigen::Vector3d& lower,
               const Eigen::Vector3d& upper, const Found& found) const {
    const Item& item = levels_[level][index];
    if ((item.lower.array() > upper.array()).any() || (item.upper.array() < lower.array()).any()) {
      return;
    }
    if (level == 0) {
      found(item_at(index));
      return;
    }
    const std::size_t end = std::min((index + 1) * width, levels_[level - 1].size());
    for (std::size_t i = index * width; i < end; ++i) overlap(level - 1, i, lower, upper, found);
  }

  template <typename Value>
  void visit(std::size_t level, std::size_t index, const Eigen::Vector3d& p, double enough,
             const Value& value, double& best) const {
    if (level == 0) {
      best = std::min(best, value(item_at(index)));
      return;
    }
    const std::vector<Item>& below = levels_[level - 1];
    const std::size_t first = index * width;
    const std::size_t count = std::min(width, below.size() - first);
    std::array<std::pair<double, std::size_t>, width> order;
    std::size_t open = 0;  // that may hold a smaller value
    for (std::size_t i = 0; i < count; ++i) {
      const Item& item = below[first + i];
      const double distance =
          (item.lower - p).cwiseMax(p - item.upper).cwiseMax(Eigen::Vector3d::Zero()).norm();
      const std::pair entry{distance - item.weight, first + i};
      if (!(entry.first < best)) continue;
      std::size_t place = open++;  // insertion sort
      for (; place > 0 && entry < order[place - 1]; --place) order[place] = order[place - 1];
      order[place] = entry;
    }
    for (std::size_t i = 0; i < open && order[i].first < best && best > enough; ++i) {
      visit(level - 1, order[i].second, p, enough, value, best);
    }
  }

  std::vector<std::int32_t> order_;        // the item at each place; empty: in their own order
  std::vector<std::vector<Item>> levels_;  // the items first, the one root last
};

}  // namespace curveskel
