#include <curveskel/advanced/union_find.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace curveskel {
namespace union_find_laws {
namespace {

/// The same joining, done by relabelling everything.
class Relabelled {
 public:
  explicit Relabelled(int count) : label_(static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < label_.size(); ++i) label_[i] = static_cast<int>(i);
  }
  bool unite(int a, int b) {
    const auto [low, high] = std::minmax({of(a), of(b)});
    if (low == high) return false;
    std::replace(label_.begin(), label_.end(), int{high}, int{low});
    return true;
  }
  [[nodiscard]] int of(int member) const { return label_[static_cast<std::size_t>(member)]; }

 private:
  std::vector<int> label_;
};

TEST(UnionFind, RootIsTheLowestMemberWhateverWasJoinedInWhichOrder) {
  std::mt19937 random(7);
  for (int count = 1; count < 60; ++count) {
    UnionFind sets(count);
    Relabelled expected(count);
    for (int step = 0; step < count; ++step) {
      const int a = static_cast<int>(random()) & 0xffff;
      const int b = static_cast<int>(random()) & 0xffff;
      ASSERT_EQ(sets.unite(a % count, b % count), expected.unite(a % count, b % count));
      for (int i = 0; i < count; ++i) ASSERT_EQ(sets.root(i), expected.of(i));
    }
  }
}

TEST(UnionFind, NumbersSetsInTheOrderOfTheirLowestMembers) {
  UnionFind sets(7);
  sets.unite(6, 2);
  sets.unite(5, 1);
  sets.unite(2, 4);
  EXPECT_EQ(sets.numbers(), (std::vector<int>{0, 1, 2, 3, 2, 1, 2}));
}

TEST(UnionFind, IsolatedMembersAreOnTheirOwnAgain) {
  UnionFind sets(6);
  for (const auto& [a, b] : {std::pair(1, 2), std::pair(2, 4), std::pair(0, 5)}) sets.unite(a, b);
  for (const int member : {1, 2, 4}) sets.isolate(member);
  EXPECT_EQ(sets.numbers(), (std::vector<int>{0, 1, 2, 3, 4, 0}));
  EXPECT_TRUE(sets.unite(4, 2));
  EXPECT_EQ(sets.root(1), 1);
}

TEST(UnionFind, LongChainsAreOneSet) {
  constexpr int count = 1 << 20;
  UnionFind sets(count);
  for (int i = count - 1; i > 0; --i) ASSERT_TRUE(sets.unite(i, i - 1));
  EXPECT_EQ(sets.root(count - 1), 0);
  EXPECT_FALSE(sets.unite(0, count - 1));
}

}  // namespace
}  // namespace union_find_laws
}  // namespace curveskel
