// Disjoint sets of 0 .. count - 1 that are joined one pair after another (union-find).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace curveskel {

/// Each member in a set of its own at first. The root of a set is its lowest member, whatever was
/// joined in which order. Paths are halved, so that a call takes O(log count) amortised.
class UnionFind {
 public:
  UnionFind() = default;
  explicit UnionFind(std::int64_t count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The lowest member of the set that `member` is in.
  [[nodiscard]] int root(int member) {
    while (parent(member) != member) member = parent(member) = parent(parent(member));
    return member;
  }

  /// Joins the sets of both; false where they are one already.
  bool unite(int a, int b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent(std::max(a, b)) = std::min(a, b);
    return true;
  }

  /// Puts `member` back into a set of its own. Precondition: so is every other member of its set
  /// before the next call of another function.
  void isolate(int member) { parent(member) = member; }

  /// The set of each member, numbered in the order of their lowest members. O(count).
  [[nodiscard]] std::vector<int> numbers() {
    std::vector<int> number(parent_.size());
    int sets = 0;
    for (int member = 0; member < static_cast<int>(parent_.size()); ++member) {
      const int lowest = root(member);
      number[static_cast<std::size_t>(member)] =
          lowest == member ? sets++ : number[static_cast<std::size_t>(lowest)];
    }
    return number;
  }

 private:
  [[nodiscard]] int& parent(int member) { return parent_[static_cast<std::size_t>(member)]; }
  std::vector<int> parent_;
};

}  // namespace curveskel
