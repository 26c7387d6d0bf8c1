#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/triangle_lanes.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

Float4 magnitude(Float4 a) { return maximum(a, -a); }

/// A segment as its middle and half of its way, for tests of separating axes.
class BoxSegment {
 public:
  BoxSegment(const Vector3d& from, const Vector3d& to, double near)
      : middle_(four(0.5 * (from + to))),
        half_(four(0.5 * (to - from))),
        near_(four(near + static_cast<double>(box_margin))) {}

  /// The children whose boxes or slabs lie farther than `near` are above 1, the others below; some
  /// of the farther ones, too.
  [[nodiscard]] Float4 misses(const WideNode& node) const {
    std::array<Float4, 3> away;
    std::array<Float4, 3> extent;
    Float4 gap = four(-1);
    Float4 height = four(0);
    Float4 rise = four(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      away[axis] = middle_[axis] - 0.5F * (node.lo[axis] + node.hi[axis]);
      extent[axis] = 0.5F * (node.hi[axis] - node.lo[axis]) + near_;
      gap = maximum(gap, magnitude(away[axis]) - extent[axis] - magnitude(half_[axis]));
      height += node.normal[axis] * middle_[axis];
      rise += node.normal[axis] * half_[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3;
      const std::size_t k = (axis + 2) % 3;
      gap = maximum(gap, magnitude(away[j] * half_[k] - away[k] * half_[j]) -
                             extent[j] * magnitude(half_[k]) - extent[k] * magnitude(half_[j]));
    }
    const Float4 reach = magnitude(rise) + near_;
    gap = maximum(gap, maximum(node.slab_lo - height, height - node.slab_hi) - reach);
    return gap > four(static_cast<double>(box_margin)) ? four(2) : four(0);
  }

 private:
  std::array<Float4, 3> middle_;
  std::array<Float4, 3> half_;
  Float4 near_;
};

/// Ericson, Real-Time Collision Detection, 2005, 5.1.9.
double squared_distance_of_segments(const Vector3d& p, const Vector3d& along, const Vector3d& q,
                                    const Vector3d& edge) {
  constexpr double tiny = 1e-300;
  const Vector3d offset = p - q;
  const double a = std::max(along.squaredNorm(), tiny);
  const double e = std::max(edge.squaredNorm(), tiny);
  const double b = along.dot(edge);
  const double c = along.dot(offset);
  const double f = edge.dot(offset);
  const double skew = a * e - b * b;
  double s = skew > 1e-14 * a * e ? std::clamp((b * f - c * e) / skew, 0.0, 1.0) : 0;
  double t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((b - c) / a, 0.0, 1.0);
  }
  return (offset + s * along - t * edge).squaredNorm();
}

/// Of a segment that does not cross the triangle.
double squared_distance_beside(const Corners& t, const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  return std::min({(closest_point(t, from) - from).squaredNorm(),
                   (closest_point(t, to) - to).squaredNorm(),
                   squared_distance_of_segments(from, along, t.a, t.b - t.a),
                   squared_distance_of_segments(from, along, t.b, t.c - t.b),
                   squared_distance_of_segments(from, along, t.c, t.a - t.c)});
}

}  // namespace

bool comes_near(const WideTree& tree, const Vector3d& from, const Vector3d& to, double near) {
  const BoxSegment segment(from, to, near);
  Stack stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const std::int32_t child = stack.pop().child;
    if (child >= 0) {
      const WideNode& node = tree.nodes[static_cast<std::size_t>(child)];
      stack.push_sorted(node, segment.misses(node), 1);
      continue;
    }
    const TriangleLeaf& leaf = tree.leaf(child);
    for (std::size_t place = 0; place < 4 && !leaf.repeated(place); ++place) {
      if (squared_distance_beside(corners(tree, leaf, place), from, to) <= near * near) return true;
    }
  }
  return false;
}

}  // namespace curveskel
