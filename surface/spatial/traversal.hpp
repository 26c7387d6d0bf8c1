// Code shared by every traversal of a WideTree. Internal to surface/.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

inline constexpr float slack = 1 + 4e-6F;  ///< for the rounding of single-precision bounds

[[nodiscard]] inline Float4 maximum(Float4 a, Float4 b) { return a > b ? a : b; }
[[nodiscard]] inline Float4 minimum(Float4 a, Float4 b) { return a < b ? a : b; }
[[nodiscard]] inline Float4 four(double value) {
  const auto v = static_cast<float>(value);
  return Float4{v, v, v, v};
}
[[nodiscard]] inline std::array<Float4, 3> four(const Eigen::Vector3d& v) {
  return {four(v.x()), four(v.y()), four(v.z())};
}

/// Lower bounds of the squared distances from p to the node's children, before slack.
[[nodiscard]] inline Float4 squared_distances(const WideNode& node,
                                              const std::array<Float4, 3>& p) {
  Float4 sum{0, 0, 0, 0};
  Float4 height{0, 0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Float4 d =
        maximum(maximum(node.lo[axis] - p[axis], p[axis] - node.hi[axis]), Float4{0, 0, 0, 0});
    sum += d * d;
    height += node.normal[axis] * p[axis];
  }
  const Float4 off_slab =
      maximum(maximum(node.slab_lo - height, height - node.slab_hi), Float4{0, 0, 0, 0});
  return maximum(sum, off_slab * off_slab);
}

/// Children still to visit, the most promising on top.
class Stack {
 public:
  struct Entry {
    float bound;
    std::int32_t child;
  };
  void push(Entry entry) { entries_[static_cast<std::size_t>(size_++)] = entry; }
  /// Pushes those children whose bound is below `limit`, the smallest bound last.
  void push_sorted(const WideNode& node, Float4 bounds, float limit) {
    const int first = size_;
    for (int i = 0; i < 4; ++i) {
      if (!(bounds[i] < limit)) continue;
      int place = size_++;
      for (; place > first && entries_[static_cast<std::size_t>(place) - 1].bound < bounds[i];
           --place) {
        entries_[static_cast<std::size_t>(place)] = entries_[static_cast<std::size_t>(place) - 1];
      }
      entries_[static_cast<std::size_t>(place)] = {bounds[i],
                                                   node.child[static_cast<std::size_t>(i)]};
    }
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  Entry pop() { return entries_[static_cast<std::size_t>(--size_)]; }

 private:
  std::array<Entry, traversal_stack> entries_;
  int size_ = 0;
};

}  // namespace curveskel
