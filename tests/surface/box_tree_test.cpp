// Laws of finding boxes that are near: as by asking each.
#include "surface/spatial/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel::box_tree_laws {
namespace {

std::vector<BoxTree::Item> scattered(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0, 100);
  std::uniform_real_distribution<double> side(0, 5);
  std::vector<BoxTree::Item> items;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d low(place(random), place(random), place(random));
    const Eigen::Vector3d sides(side(random), side(random), side(random));
    items.push_back({{low, low + sides}, side(random)});
  }
  return items;
}

BoxTree tree_about(const std::vector<BoxTree::Item>& items) {
  Positions middles(static_cast<Eigen::Index>(items.size()), 3);
  for (std::size_t k = 0; k < items.size(); ++k) {
    middles.row(static_cast<Eigen::Index>(k)) = items[k].box.center().transpose();
  }
  return BoxTree(middles);
}

/// While items come, as a body grows.
TEST(BoxTree, FindsTheNearestAndAllWithinOfThoseThatAreThere) {
  std::mt19937 random(7);
  for (const int count : {1, 2, 8, 9, 65, 700}) {
    const std::vector<BoxTree::Item> items = scattered(count, random);
    const std::vector<BoxTree::Item> asked = scattered(20, random);
    BoxTree tree = tree_about(items);
    for (int there = 0; there < count; ++there) {
      tree.put(idx(there), items[idx(there)]);
      if (there % 50 != 0 && there + 1 != count) continue;
      const BoxTree::Item& from = asked[idx(there % 20)];
      const auto bound = [&](const BoxTree::Item& item) {
        return from.box.exteriorDistance(item.box) - item.weight;
      };
      double least = std::numeric_limits<double>::infinity();
      tree.search(bound, least, [&](std::size_t k) { least = std::min(least, bound(items[k])); });
      const double most = least + 10;
      std::vector<std::size_t> found;
      tree.search(bound, most, [&](std::size_t k) { found.push_back(k); });
      std::sort(found.begin(), found.end());
      double expected_least = std::numeric_limits<double>::infinity();
      std::vector<std::size_t> expected;
      for (int k = 0; k <= there; ++k) {
        expected_least = std::min(expected_least, bound(items[idx(k)]));
        if (bound(items[idx(k)]) <= most) expected.push_back(idx(k));
      }
      EXPECT_EQ(least, expected_least);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, WithoutItemsFindsNone) {
  const double most = std::numeric_limits<double>::infinity();
  for (const BoxTree& tree : {BoxTree(Positions(0, 3)), BoxTree(Positions::Zero(9, 3))}) {
    tree.search([](const BoxTree::Item&) { return 0.0; }, most,
                [](std::size_t k) { ADD_FAILURE() << k; });
  }
}

}  // namespace
}  // namespace curveskel::box_tree_laws
