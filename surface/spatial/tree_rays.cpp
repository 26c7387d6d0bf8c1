// S. Woop et al., Watertight ray/triangle intersection, 2013.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/wide_vectors.hpp"
#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/triangle_lanes.hpp"

namespace curveskel {
namespace {

// Single-precision slabs; the ray starts within or at the frame's box.
class BoxRay {
 public:
  BoxRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) : origin_(four(origin)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = direction[static_cast<Eigen::Index>(axis)];
      inverse_[axis] = four(std::abs(d) < 1e-20 ? std::copysign(1e20, d) : 1 / d);
      forward_[axis] = !std::signbit(d);
    }
  }
  // Entry depths of the four boxes; infinity where the ray misses.
  [[nodiscard]] Float4 entries(const WideNode& node) const {
    Float4 enter{0, 0, 0, 0};
    Float4 leave = four(1e30);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float4& near = forward_[axis] ? node.lo[axis] : node.hi[axis];
      const Float4& far = forward_[axis] ? node.hi[axis] : node.lo[axis];
      enter = maximum(enter, (near - origin_[axis]) * inverse_[axis]);
      leave = minimum(leave, (far - origin_[axis]) * inverse_[axis]);
    }
    return enter <= leave * slack ? enter : four(infinity);
  }

 private:
  std::array<Float4, 3> origin_;
  std::array<Float4, 3> inverse_;
  std::array<bool, 3> forward_{};
};

// The distance to the ray's entry into the surface's box: 0 from within, infinity if never.
double entry_depth(const WideTree& tree, const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction) {
  constexpr double margin = 1e-9;
  double enter = 0;
  double leave = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = tree.lower[axis] - margin - origin[axis];
    const double hi = tree.upper[axis] + margin - origin[axis];
    if (direction[axis] == 0) {
      if (lo > 0 || hi < 0) return infinity;
      continue;
    }
    const double a = lo / direction[axis];
    const double b = hi / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1 + 1e-9) ? enter : infinity;
}

// Visits the leaves that the ray may meet, nearest boxes first, while visit(leaf) returns a depth
// below which boxes are still of interest.
template <typename Visit>
void along_ray(const WideTree& tree, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction, double limit, const Visit& visit) {
  const double start = entry_depth(tree, origin, direction);
  if (!(start <= limit)) return;
  const BoxRay ray(origin + start * direction, direction);
  const auto bound = [start](double depth) {
    return static_cast<float>(depth - start) * slack + 2 * box_margin;
  };
  float open = bound(limit);
  Stack stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const auto [depth, child] = stack.pop();
    if (!(depth < open)) continue;
    if (child < 0) {
      open = bound(visit(tree.leaf(child)));
    } else {
      const WideNode& node = tree.nodes[static_cast<std::size_t>(child)];
      stack.push_sorted(node, ray.entries(node), open);
    }
  }
}

// Fixed unit vectors spread over the sphere, aligned with nothing that is likely to be modelled.
Eigen::Vector3d scattered_direction(int i) {
  const double z = 1 - 2 * std::fmod(0.2887 + i * 0.7548776662466927, 1.0);
  const double angle = 2 * 3.141592653589793 * std::fmod(0.1163 + i * 0.618033988749895, 1.0);
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

/// With the inverses of their coordinates, none of which is 0.
class ScatteredDirections {
 public:
  ScatteredDirections() {
    for (std::size_t i = 0; i < size(); ++i) {
      directions_[i] = scattered_direction(static_cast<int>(i));
      inverses_[i] = directions_[i].cwiseInverse();
    }
  }
  [[nodiscard]] const Eigen::Vector3d& operator[](std::size_t i) const { return directions_[i]; }
  [[nodiscard]] const Eigen::Vector3d& inverse(std::size_t i) const { return inverses_[i]; }
  [[nodiscard]] static constexpr std::size_t size() { return 24; }

 private:
  std::array<Eigen::Vector3d, 24> directions_;
  std::array<Eigen::Vector3d, 24> inverses_;
};

/// The distance from a point within the surface's box to where the ray leaves it.
double exit_depth(const WideTree& tree, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& inverse) {
  return ((tree.lower - origin).cwiseProduct(inverse))
      .cwiseMax((tree.upper - origin).cwiseProduct(inverse))
      .minCoeff();
}

struct Winding {
  int turns = 0;
  bool clear = true;  // no crossing too close to an edge to be sure of
};

Winding winding_along(const WideTree& tree, const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction) {
  constexpr double doubt = 1e-14;  // local units, the distance to an edge
  const ShearedRay sheared(origin, direction);
  Winding winding;
  along_ray(tree, origin, direction, infinity, [&](const TriangleLeaf& leaf) {
    const Crossings crossing = crossings(tree, leaf, sheared);
    const Double4 lowest = lesser(crossing.u, lesser(crossing.v, crossing.w));
    const Double4 highest = greater(crossing.u, greater(crossing.v, crossing.w));
    const Double4 doubtful = spread<Double4>(doubt) * crossing.size;
    const Mask4 misses = (lowest < -doubtful) & (highest > doubtful);
    if (!any_of(~misses)) return infinity;
    for (int place = 0; place < 4; ++place) {
      if (misses[place] != 0 || leaf.repeated(static_cast<std::size_t>(place))) continue;
      const double determinant = crossing.determinant[place];
      const double depth = crossing.scaled_depth[place];
      const double doubtful_here = doubtful[place];
      if (std::abs(lowest[place]) <= doubtful_here || std::abs(highest[place]) <= doubtful_here) {
        const bool behind = std::abs(determinant) > 3 * doubtful_here && depth * determinant < 0;
        if (!behind) winding.clear = false;
      }
      if (determinant > 0 && depth > 0) ++winding.turns;
      if (determinant < 0 && depth < 0) --winding.turns;
    }
    return infinity;
  });
  return winding;
}

bool outside_box(const WideTree& tree, const Eigen::Vector3d& p) {
  return (p.array() < tree.lower.array()).any() || (p.array() > tree.upper.array()).any();
}

// Takes the leaf's first triangle on the ray if it is nearer than the hit so far.
void meet(const WideTree& tree, const TriangleLeaf& leaf, const ShearedRay& sheared,
          LocalHit& hit) {
  const Crossings crossing = crossings(tree, leaf, sheared);
  const auto zero = spread<Double4>(0);
  const Double4 lowest = lesser(crossing.u, lesser(crossing.v, crossing.w));
  const Double4 highest = greater(crossing.u, greater(crossing.v, crossing.w));
  const Mask4 misses = ((lowest < zero) & (highest > zero)) | (crossing.determinant == zero);
  if (!any_of(~misses)) return;
  for (int place = 0; place < 4; ++place) {
    if (misses[place] != 0) continue;
    const double depth = crossing.scaled_depth[place] / crossing.determinant[place];
    if (depth > 0 && depth <= hit.distance && (hit.triangle < 0 || depth < hit.distance)) {
      hit.distance = depth;
      hit.triangle = leaf.triangle(static_cast<std::size_t>(place));
    }
  }
}

// The leaves that a plane meets within some distance of a point, nearest first: one traversal for
// any number of rays.
class LeavesInPlane {
 public:
  // False if there are too many.
  bool gather(const WideTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& normal,
              double limit) {
    const std::array<Float4, 3> p = four(origin);
    const std::array<Float4, 3> n = four(normal);
    const std::array<Float4, 3> size = four(Eigen::Vector3d(normal.cwiseAbs()));
    const float open = static_cast<float>(limit * limit) * slack;
    Stack stack;
    stack.push({0, 0});
    while (!stack.empty()) {
      const WideNode& node = tree.nodes[static_cast<std::size_t>(stack.pop().child)];
      Float4 height{0, 0, 0, 0};  // of the boxes' middles above the plane, doubled
      Float4 reach = four(4 * static_cast<double>(box_margin));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        height += n[axis] * ((node.lo[axis] - p[axis]) + (node.hi[axis] - p[axis]));
        reach += size[axis] * (node.hi[axis] - node.lo[axis]);
      }
      const auto meets = (height <= reach) & (-height <= reach);
      Float4 bounds = meets ? squared_distances(node, p) : four(infinity);
      for (int i = 0; i < 4; ++i) {
        if (!(bounds[i] < open) || node.child[static_cast<std::size_t>(i)] >= 0) continue;
        if (!add(node, i)) return false;
        bounds[i] = std::numeric_limits<float>::infinity();
      }
      stack.push_sorted(node, bounds, open);
    }
    close();
    return true;
  }

  [[nodiscard]] LocalHit find_hit(const WideTree& tree, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction, double limit) const {
    const ShearedRay sheared(origin, direction);
    const BoxRay ray(origin, direction);
    const auto bound = [](double depth) {
      return static_cast<float>(depth) * slack + 2 * box_margin;
    };
    LocalHit hit{limit, -1};
    for (std::size_t g = 0; g < groups_; ++g) {
      const Float4 entries = ray.entries(group_[g]);
      for (int i = 0; i < 4; ++i) {
        if (!(entries[i] < bound(hit.distance))) continue;
        meet(tree, tree.leaf(group_[g].child[static_cast<std::size_t>(i)]), sheared, hit);
      }
    }
    return hit;
  }

 private:
  bool add(const WideNode& from, int i) {
    if (used_ == 0 && groups_ == group_.size()) return false;
    if (used_ == 0) ++groups_;
    WideNode& group = group_[groups_ - 1];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      group.lo[axis][used_] = from.lo[axis][i];
      group.hi[axis][used_] = from.hi[axis][i];
    }
    group.child[static_cast<std::size_t>(used_)] = from.child[static_cast<std::size_t>(i)];
    used_ = (used_ + 1) % 4;
    return true;
  }

  // No ray enters the rest of the last group.
  void close() {
    for (; used_ != 0; used_ = (used_ + 1) % 4) {
      WideNode& group = group_[groups_ - 1];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        group.lo[axis][used_] = 1e30F;
        group.hi[axis][used_] = -1e30F;
      }
    }
  }

  std::array<WideNode, 64> group_;  // boxes and leaves alone
  std::size_t groups_ = 0;
  int used_ = 0;  // places of the last group, 0 = all
};

}  // namespace

CURVESKEL_WIDE_VECTORS
LocalHit find_hit(const WideTree& tree, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction, double limit) {
  const ShearedRay sheared(origin, direction);
  LocalHit hit{limit, -1};
  along_ray(tree, origin, direction, hit.distance, [&](const TriangleLeaf& leaf) {
    meet(tree, leaf, sheared, hit);
    return hit.distance;
  });
  return hit;
}

CURVESKEL_WIDE_VECTORS
void find_distances_in_plane(const WideTree& tree, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& normal,
                             std::span<const Eigen::Vector3d> directions,
                             const Eigen::Matrix3d& rotation, double limit,
                             std::span<double> distances) {
  LeavesInPlane leaves;
  const bool gathered = !outside_box(tree, origin) && leaves.gather(tree, origin, normal, limit);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d direction = rotation.transpose() * directions[i];
    const LocalHit hit = gathered ? leaves.find_hit(tree, origin, direction, limit)
                                  : find_hit(tree, origin, direction, limit);
    distances[i] = hit.triangle < 0 ? infinity : hit.distance;
  }
}

CURVESKEL_WIDE_VECTORS
bool winds_around(const WideTree& tree, const Eigen::Vector3d& p) {
  if (outside_box(tree, p)) return false;
  static const ScatteredDirections directions;
  // The way out that is shortest meets least.
  std::size_t first = 0;
  double shortest = infinity;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double depth = exit_depth(tree, p, directions.inverse(i));
    if (depth >= shortest) continue;
    shortest = depth;
    first = i;
  }
  Winding winding;
  for (std::size_t attempt = 0; attempt < directions.size(); ++attempt) {
    winding = winding_along(tree, p, directions[(first + attempt) % directions.size()]);
    if (winding.clear) break;
  }
  return winding.turns != 0;
}

}  // namespace curveskel
