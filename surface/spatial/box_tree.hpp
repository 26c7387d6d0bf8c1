// Boxes in groups of eight along the Morton curve of their middles, groups of eight groups and so
// on: what is near is found without asking each.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "surface/spatial/morton.hpp"

namespace curveskel {

/// A row for each box. Precondition: none is empty.
[[nodiscard]] inline Positions middles_of_boxes(const std::vector<Eigen::AlignedBox3d>& boxes) {
  Positions middles(static_cast<Eigen::Index>(boxes.size()), 3);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    middles.row(static_cast<Eigen::Index>(k)) = boxes[k].center().transpose();
  }
  return middles;
}

class BoxTree {
 public:
  struct Item {
    Eigen::AlignedBox3d box;
    double weight = 0;  ///< of a group the largest of its items'
  };

  /// Room for an item about each middle; none is there yet.
  explicit BoxTree(const Positions& middles) : place_of_(idx(middles.rows())) {
    if (middles.rows() > 0) number_at_ = along_morton_curve(middles, 1);
    for (std::size_t place = 0; place < number_at_.size(); ++place) {
      place_of_[idx(number_at_[place])] = place;
    }
    levels_.emplace_back(place_of_.size());
    while (levels_.back().size() > 1) {
      levels_.emplace_back((levels_.back().size() + width - 1) / width);
    }
  }

  void put(std::size_t number, const Item& item) {
    std::size_t at = place_of_[number];
    for (std::vector<Item>& level : levels_) {
      level[at].box.extend(item.box);
      level[at].weight = std::max(level[at].weight, item.weight);
      at /= width;
    }
  }

  /// Calls visit(number) for each item with bound(item) <= most, which may become less meanwhile;
  /// the nearest first, as far as groups tell. Precondition: the bound of a group's item, the box
  /// and the largest weight of all, is no more than that of any in it.
  template <typename Bound, typename Visit>
  void search(const Bound& bound, const double& most, const Visit& visit) const {
    if (!levels_.front().empty()) search_below(levels_.size() - 1, 0, bound, most, visit);
  }

 private:
  static constexpr std::size_t width = 8;

  template <typename Bound, typename Visit>
  void search_below(std::size_t level, std::size_t index, const Bound& bound, const double& most,
                    const Visit& visit) const {
    if (level == 0) {
      visit(idx(number_at_[index]));
      return;
    }
    const std::vector<Item>& below = levels_[level - 1];
    const std::size_t end = std::min((index + 1) * width, below.size());
    std::array<std::pair<double, std::size_t>, width> order;
    std::size_t open = 0;
    for (std::size_t i = index * width; i < end; ++i) {
      if (below[i].box.isEmpty()) continue;
      const std::pair entry{bound(below[i]), i};
      std::size_t place = open++;  // insertion sort
      for (; place > 0 && entry < order[place - 1]; --place) order[place] = order[place - 1];
      order[place] = entry;
    }
    for (std::size_t i = 0; i < open && order[i].first <= most; ++i) {
      search_below(level - 1, order[i].second, bound, most, visit);
    }
  }

  std::vector<std::int32_t> number_at_;    // along the curve
  std::vector<std::size_t> place_of_;      // by number
  std::vector<std::vector<Item>> levels_;  // the items along the curve first, the one root last
};

}  // namespace curveskel
