// Laws of the search over a sequence: what asking every item would give, without asking them all,
// though near items come far from each other, as the leaves of a tree do in a file.
#include "skeleton/graph/sequence_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "surface/spatial/morton.hpp"

namespace curveskel::sequence_tree_laws {
namespace {

using Eigen::Vector3d;

/// Balls strewn over a cube, touched by about as many neighbours for any number of them.
struct Strewn {
  explicit Strewn(int count) : centres(count, 3) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(0, 1);
    for (double& x : centres.reshaped()) x = anywhere(random);
    radius = 0.3 / std::cbrt(count);
  }

  [[nodiscard]] double gap(std::size_t i, const Vector3d& p) const {
    return (p.transpose() - centres.row(static_cast<Eigen::Index>(i))).norm() - radius;
  }
  [[nodiscard]] std::vector<SequenceTree::Item> items() const {
    std::vector<SequenceTree::Item> all;
    for (const auto& c : centres.rowwise()) all.push_back({c.transpose(), c.transpose(), radius});
    return all;
  }
  [[nodiscard]] SequenceTree tree() const { return {items(), along_morton_curve(centres, 1)}; }
  [[nodiscard]] double least_gap(const Vector3d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(centres.rows()); ++i) {
      least = std::min(least, gap(i, p));
    }
    return least;
  }

  Positions centres;
  double radius;
};

std::vector<Vector3d> places(int count) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> anywhere(-0.1, 1.1);
  std::vector<Vector3d> all;
  all.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) all.emplace_back(anywhere(random), anywhere(random), 0.5);
  return all;
}

TEST(SequenceTree, InAnyOrderFindsWhatAskingAllWould) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const int count : {1, 2, 8, 9, 700}) {
    const Strewn balls(count);
    const SequenceTree tree = balls.tree();
    for (const Vector3d& p : places(60)) {
      const auto gap = [&](std::size_t i) { return balls.gap(i, p); };
      EXPECT_EQ(tree.minimum(p, -infinity, gap), balls.least_gap(p));
      EXPECT_EQ(tree.minimum(p, -infinity, gap, 0), balls.least_gap(p));
      EXPECT_EQ(tree.reaches(p, gap), balls.least_gap(p) <= 0);
    }
  }
}

TEST(SequenceTree, OverlappingItemsAreNamedByTheirOwnNumbers) {
  const Strewn balls(500);
  const SequenceTree tree = balls.tree();
  const Vector3d low(0.2, 0.3, 0.4);
  const Vector3d high(0.5, 0.5, 0.7);
  std::vector<std::size_t> found;
  tree.overlapping(low, high, [&](std::size_t i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> needed;
  for (std::size_t i = 0; i < 500; ++i) {
    const Vector3d c = balls.centres.row(static_cast<Eigen::Index>(i));
    if ((c.array() >= low.array()).all() && (c.array() <= high.array()).all()) needed.push_back(i);
  }
  EXPECT_FALSE(needed.empty());
  EXPECT_EQ(found, needed);
}

/// Of the items, for all places together.
template <typename Search>
int looks(int count, const Search& search) {
  const Strewn balls(count);
  const SequenceTree tree = balls.tree();
  int asked = 0;
  for (const Vector3d& p : places(200)) {
    search(tree, p, [&](std::size_t i) {
      ++asked;
      return balls.gap(i, p);
    });
  }
  return asked;
}

TEST(SequenceTree, SixteenTimesTheItemsTakeHardlyMoreLooks) {
  const auto nearest = [](const SequenceTree& tree, const Vector3d& p, const auto& gap) {
    (void)tree.minimum(p, 0, gap);
  };
  const auto any = [](const SequenceTree& tree, const Vector3d& p, const auto& gap) {
    (void)tree.reaches(p, gap);
  };
  EXPECT_LT(looks(16000, nearest), 2 * looks(1000, nearest));
  EXPECT_LT(looks(16000, any), 2 * looks(1000, any));
}

TEST(SequenceTree, LooksAtNoItemThatCannotReach) {
  const auto far_away = [](const SequenceTree& tree, const Vector3d& p, const auto& gap) {
    EXPECT_FALSE(tree.reaches(p + Vector3d(9, 0, 0), gap));
  };
  EXPECT_EQ(looks(1000, far_away), 0);
}

}  // namespace
}  // namespace curveskel::sequence_tree_laws
