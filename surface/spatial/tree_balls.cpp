// J. Ma et al., 3D medial axis point approximation using nearest neighbors and the normal field,
// 2012; here as one traversal in place of iterated nearest points.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/wide_vectors.hpp"
#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/triangle_lanes.hpp"

namespace curveskel {
namespace {

// Edges and faces are chords of a curved surface: a ball that meets one closer to the tangent plane
// than this is bounded by the chord, not by the surface.
constexpr double chord_sine = 0.5;

// On a round shape nearly every triangle bounds the ball about as well as the best: look only for
// what bounds it by this factor.
constexpr double worthwhile = 0.995;

// The ball touches the tangent plane with normal n at p and grows with its centre on n.
class GrowingBall {
 public:
  GrowingBall(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double min_sine)
      : p_(p), n_(n), min_sine_(min_sine), chord_sine_(std::max(min_sine, chord_sine)) {}

  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] bool bounded() const { return bounded_; }

  void meet(const WideTree& tree, const TriangleLeaf& leaf) {
    const auto p = spread<Double4>(p_);
    const std::array<Lanes3<Double4>, 3> corner{corners_of_leaf(tree, leaf, 0) - p,
                                                corners_of_leaf(tree, leaf, 1) - p,
                                                corners_of_leaf(tree, leaf, 2) - p};
    const Double4 at_corners = radii_at(corner);
    const Mask4 on_chord = chords_in_question(corner);
    for (std::size_t pair = 0; pair < leaf.pairs(); ++pair) {
      const int first = 2 * static_cast<int>(pair);
      bound(std::min(at_corners[first], at_corners[first + 1]));
      if ((on_chord[first] | on_chord[first + 1]) == 0) continue;
      const double reach = radius_ * worthwhile;
      const Double2 distance2 = squared_distance(
          corners_of_pair(tree, leaf, 0, pair), corners_of_pair(tree, leaf, 1, pair),
          corners_of_pair(tree, leaf, 2, pair), spread<Double2>(p_ + reach * n_));
      for (int lane = 0; lane < 2; ++lane) {
        if (on_chord[first + lane] == 0 || distance2[lane] >= reach * reach) continue;
        const auto at = [&](std::size_t k) {
          return Eigen::Vector3d(corner[k].x[first + lane], corner[k].y[first + lane],
                                 corner[k].z[first + lane]);
        };
        meet_chords(at(0), at(1), at(2));
      }
    }
  }

 private:
  void bound(double radius) {
    if (!(radius < radius_)) return;
    radius_ = radius;
    bounded_ = true;
  }

  // Of the triangles the least radii at which the ball meets corners; infinity for those too low.
  [[nodiscard]] Double4 radii_at(const std::array<Lanes3<Double4>, 3>& corner) const {
    const auto n = spread<Double4>(n_);
    const auto zero = spread<Double4>(0);
    const auto sine2 = spread<Double4>(min_sine_ * min_sine_);
    auto least = spread<Double4>(infinity);
    for (const Lanes3<Double4>& e : corner) {
      const Double4 height = dot(n, e);
      const Double4 length2 = dot(e, e);
      const Mask4 is_high = (height > zero) & (height * height >= sine2 * length2);
      const Double4 radius = length2 / (height + height);
      least = lesser(is_high ? radius : spread<Double4>(infinity), least);
    }
    return least;
  }

  // True if a triangle may hold a point seen under chord_sine_. n.q - sine |q| is a concave
  // function of q, so its tangent at corner 0 bounds it from above.
  [[nodiscard]] Mask4 chords_in_question(const std::array<Lanes3<Double4>, 3>& corner) const {
    const auto n = spread<Double4>(n_);
    const Double4 length2 = dot(corner[0], corner[0]);
    const Double4 length{std::sqrt(length2[0]), std::sqrt(length2[1]), std::sqrt(length2[2]),
                         std::sqrt(length2[3])};
    const Double4 factor = spread<Double4>(chord_sine_) / length;
    Double4 highest = dot(n, corner[0]) - factor * length2;
    for (const std::size_t k : {1UL, 2UL}) {
      const Double4 height = dot(n, corner[k]) - factor * dot(corner[0], corner[k]);
      highest = greater(highest, height);
    }
    // A corner at p itself has no tangent: let the triangle through.
    return (highest >= spread<Double4>(0)) | (length2 == spread<Double4>(0));
  }

  void meet_chords(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    // On a triangle through p the ball would end at once: its corners stand for it.
    constexpr double touching = 1e-10;
    if (closest_point({a, b, c}, {0, 0, 0}).squaredNorm() <= touching * touching) return;
    meet_line(a, b);
    meet_line(b, c);
    meet_line(c, a);
    meet_plane(a, b, c);
  }

  void meet_at(const Eigen::Vector3d& e) {
    const double height = n_.dot(e);
    const double length2 = e.squaredNorm();
    if (height <= 0 || height * height < chord_sine_ * chord_sine_ * length2) return;
    bound(length2 / (2 * height));
  }

  // Across the line, |r n - from|^2 = r^2; of the two roots one is positive.
  void meet_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d along = to - from;
    const double length2 = along.squaredNorm();
    if (!(length2 > 0)) return;
    const Eigen::Vector3d across = from - along * (from.dot(along) / length2);
    const double across2 = across.squaredNorm();
    const double lean = n_.dot(along);
    const double height = n_.dot(across);
    const double root = height + std::sqrt(height * height + lean * lean * across2 / length2);
    if (!(root > 0)) return;
    const double t = (across2 / root * n_ - from).dot(along) / length2;
    if (t > 0 && t < 1) meet_at(from + t * along);
  }

  void meet_plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = b - a;
    const Eigen::Vector3d ac = c - a;
    const Eigen::Vector3d normal = ab.cross(ac);
    const double length = normal.norm();
    if (!(length > 0)) return;
    const Eigen::Vector3d away = normal / (normal.dot(a) < 0 ? -length : length);
    const double closing = 1 + away.dot(n_);
    if (!(closing > 1e-12)) return;
    const Eigen::Vector3d touch = (away.dot(a) / closing) * (n_ + away);
    const double u = ab.cross(touch - a).dot(normal);
    const double v = (touch - a).cross(ac).dot(normal);
    if (u >= 0 && v >= 0 && u + v <= length * length) meet_at(touch);
  }

  Eigen::Vector3d p_;
  Eigen::Vector3d n_;
  double min_sine_;
  double chord_sine_;
  double radius_ = 1;  // no ball within the surface is that large in the local frame
  bool bounded_ = false;
};

// Lower bounds of the radius at which the ball meets the children's boxes; infinity where no point
// of a box is high enough above the tangent plane.
class RadiusBounds {
 public:
  RadiusBounds(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double min_sine)
      : p_(four(p)), n_(four(n)), sine2_(static_cast<float>(min_sine * min_sine) / slack) {}

  [[nodiscard]] Float4 operator()(const WideNode& node) const {
    const Float4 zero{0, 0, 0, 0};
    Float4 highest = zero;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      highest +=
          maximum(n_[axis] * (node.lo[axis] - p_[axis]), n_[axis] * (node.hi[axis] - p_[axis]));
    }
    const Float4 distance2 = squared_distances(node, p_);
    const auto possible = (highest > zero) & (highest * highest >= sine2_ * distance2);
    return possible ? distance2 / (highest + highest) : four(infinity);
  }

 private:
  std::array<Float4, 3> p_;
  std::array<Float4, 3> n_;
  float sine2_;
};

}  // namespace

CURVESKEL_WIDE_VECTORS
double find_ball_radius(const WideTree& tree, const Eigen::Vector3d& p, const Eigen::Vector3d& n,
                        double min_sine) {
  GrowingBall ball(p, n, min_sine);
  const RadiusBounds radius_bounds(p, n, min_sine);
  Stack stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const auto [bound, child] = stack.pop();
    const double reach = ball.radius() * worthwhile;
    const float open = static_cast<float>(reach) * slack;
    if (!(bound < open)) continue;
    if (child < 0) {
      ball.meet(tree, tree.leaf(child));
      continue;
    }
    // Growing balls are nested: a child that the ball so far misses cannot bound it further.
    const WideNode& node = tree.nodes[static_cast<std::size_t>(child)];
    const Float4 off_centre2 = squared_distances(node, four(p + reach * n));
    const Float4 meets = four(reach * reach * static_cast<double>(slack));
    stack.push_sorted(node, off_centre2 < meets ? radius_bounds(node) : four(infinity), open);
  }
  return ball.bounded() ? ball.radius() : infinity;
}

}  // namespace curveskel
