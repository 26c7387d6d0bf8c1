// Lines between two points of a curve that stay inside, straight or bent.
#pragma once

#include <cmath>
#include <vector>

#include "skeleton/embed/contain/ball_chains.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// Inside and away from the surface, or moved there if that can be done nearby.
inline CurvePoint pulled_inside(const SurfaceTree& tree, const CurvePoint& p) {
  const double radius = p.radius(tree);
  if (radius >= least_radius) return p;
  const auto nearest = tree.nearest(p.place());
  Point inward = radius < 0 ? Point(nearest.point - p.place()) : Point(p.place() - nearest.point);
  if (inward.norm() == 0) return p;
  inward.normalize();
  const auto ball = tree.inscribed_ball(nearest.point, inward);
  if (!std::isfinite(ball.radius)) return p;
  const CurvePoint moved = ball.centre;
  return moved.radius(tree) > radius ? moved : p;
}

inline bool sees_straight(const SurfaceTree& tree, const CurvePoint& p, const CurvePoint& q) {
  return p.radius(tree) > 0 && q.radius(tree) > 0 && !crosses(tree, p.place(), q.place());
}

/// Appends the points that have to come between p and q, straight where that stays inside, bent
/// inwards where not. False if some gap could not be covered; `inserted` is then best left unused.
class Cover {
 public:
  Cover(const SurfaceTree& tree, bool may_bend) : tree_(tree), may_bend_(may_bend) {}

  bool between(const CurvePoint& p, const CurvePoint& q, std::vector<CurvePoint>& inserted,
               int depth = 0) const {
    const double length = (q.place() - p.place()).norm();
    const bool both_inside = p.radius(tree_) > 0 && q.radius(tree_) > 0;
    if (both_inside && length <= p.radius(tree_) + q.radius(tree_)) return true;
    if (sees_straight(tree_, p, q)) return true;
    if (depth == deepest || !both_inside) return false;
    CurvePoint middle = Point(0.5 * (p.place() + q.place()));
    if (middle.radius(tree_) < least_radius) {
      if (!may_bend_) return false;
      const CurvePoint moved = pulled_inside(tree_, middle);
      // A centre far from both ends belongs to another part of the surface.
      if ((moved.place() - middle.place()).norm() > length) return false;
      middle = moved;
    }
    if (!between(p, middle, inserted, depth + 1)) return false;
    inserted.push_back(middle);
    return between(middle, q, inserted, depth + 1);
  }

 private:
  static constexpr int deepest = 10;

  const SurfaceTree& tree_;
  bool may_bend_;
};

}  // namespace curveskel
