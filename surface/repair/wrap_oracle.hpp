// The questions that a wrap asks its triangles, answered as CGAL's own oracle answers them.
#pragma once

#include <CGAL/Alpha_wrap_3/internal/Alpha_wrap_3.h>
#include <CGAL/Alpha_wrap_3/internal/Triangle_soup_oracle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace curveskel {

/// CGAL asks each box of its tree with exact predicates. Here a box is asked in plain numbers:
/// one that they leave in doubt is entered, or asked exactly where entering it might change the
/// answer. The answers are the same to the last bit.
template <typename Kernel>
class WrapOracle : public CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<Kernel> {
  using Base = CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<Kernel>;
  using Traits =
      typename CGAL::Alpha_wraps_3::internal::TS_oracle_traits<Kernel>::AABB_tree::AABB_traits;
  using Point = typename Traits::Point_3;
  using Number = typename Traits::FT;
  using Primitive = typename Traits::Primitive;
  using Node = CGAL::AABB_node<Traits>;
  using Corner = std::array<double, 3>;

  static constexpr double doubtful = 1e-12;  // far above the rounding of a dozen operations

 public:
  using Base::Base;

  template <typename Query>
  [[nodiscard]] bool do_intersect(const Query& query) const {
    Meeting<Query> meeting(query, this->tree().traits(), *triangles_);
    this->tree().traversal(query, meeting);
    return meeting.is_found();
  }

  [[nodiscard]] Point closest_point(const Point& p) const {
    Nearest nearest(p, this->tree().best_hint(p).first, this->tree().traits(), *triangles_);
    this->tree().traversal(p, nearest);
    return nearest.point();
  }

  [[nodiscard]] bool first_intersection(const Point& p, const Point& q, Point& found,
                                        const Number& offset) const {
    const auto distance = [this](const Point& at) {
      return CGAL::approximate_sqrt(CGAL::squared_distance(at, closest_point(at)));
    };
    constexpr double precision = 1e-2;  // of the offset, as CGAL's
    CGAL::Alpha_wraps_3::internal::Offset_intersection<typename Base::Geom_traits,
                                                       decltype(distance)>
        search(distance, offset, precision * offset, 1);
    return search.first_intersection(p, q, found);
  }

 private:
  /// A triangle stands in several boxes, and is asked once a query.
  class Triangles {
   public:
    void begin() { ++query_; }

    [[nodiscard]] bool is_new(std::size_t triangle) {
      if (triangle >= last_query_.size()) last_query_.resize(triangle + 1, 0);
      if (last_query_[triangle] == query_) return false;
      last_query_[triangle] = query_;
      return true;
    }

   private:
    std::vector<std::uint64_t> last_query_;
    std::uint64_t query_ = 0;
  };

  static double squared_to_box(const Point& p, const CGAL::Bbox_3& box) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double away = std::max({0.0, (box.min)(k)-p[k], p[k] - (box.max)(k)});
      sum += away * away;
    }
    return sum;
  }

  /// The side of a plane through one corner on which the body is not.
  struct Outer {
    Corner corner;
    Corner normal;
    double product;  // of its edges: what the normal's rounding is in proportion to

    [[nodiscard]] bool holds(const CGAL::Bbox_3& box) const {
      double nearest = 0;
      double lengths = 0;
      for (int k = 0; k < 3; ++k) {
        const double low = (box.min)(k)-corner[std::size_t(k)];
        const double high = (box.max)(k)-corner[std::size_t(k)];
        const double along = normal[std::size_t(k)];
        nearest += along * (along > 0 ? low : high);
        lengths += std::max(std::abs(low), std::abs(high));
      }
      return nearest > doubtful * product * lengths;
    }
  };

  /// Boxes that a ball certainly does not reach.
  class AwayFromBall {
   public:
    template <typename Ball>
    explicit AwayFromBall(const Ball& ball)
        : center_(ball.boundary().center()), squared_(ball.boundary().squared_radius()) {}

    [[nodiscard]] bool operator()(const CGAL::Bbox_3& box) const {
      return squared_to_box(center_, box) > squared_ * (1 + doubtful);
    }

   private:
    Point center_;
    double squared_;
  };

  /// Boxes that a tetrahedron certainly does not reach.
  class AwayFromTetrahedron {
   public:
    template <typename Tetrahedron>
    explicit AwayFromTetrahedron(const Tetrahedron& given) : box_(given.m_bbox) {
      for (int k = 0; k < 4; ++k) {
        const auto at = [&](int corner) { return given.m_tet.vertex((k + corner) % 4); };
        add(at(1), at(2), at(3), at(0));
      }
    }

    [[nodiscard]] bool operator()(const CGAL::Bbox_3& box) const {
      if (!CGAL::do_overlap(box_, box)) return true;
      return std::any_of(outer_.begin(), outer_.begin() + count_,
                         [&](const Outer& side) { return side.holds(box); });
    }

   private:
    /// The side of a, b and c on which the opposite corner is not, unless all are nearly in a
    /// plane.
    void add(const Point& a, const Point& b, const Point& c, const Point& opposite) {
      Corner ab{};
      Corner ac{};
      std::array<double, 3> lengths{};
      for (std::size_t k = 0; k < 3; ++k) {
        ab[k] = b[int(k)] - a[int(k)];
        ac[k] = c[int(k)] - a[int(k)];
        lengths[0] += std::abs(ab[k]);
        lengths[1] += std::abs(ac[k]);
        lengths[2] += std::abs(opposite[int(k)] - a[int(k)]);
      }
      Outer side{{a[0], a[1], a[2]}, {}, lengths[0] * lengths[1]};
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        side.normal[k] = ab[i] * ac[j] - ab[j] * ac[i];
        height += side.normal[k] * (opposite[int(k)] - a[int(k)]);
      }
      if (!(std::abs(height) > doubtful * side.product * lengths[2])) return;
      if (height > 0) {
        for (double& along : side.normal) along = -along;
      }
      outer_[std::size_t(count_++)] = side;
    }

    CGAL::Bbox_3 box_;
    std::array<Outer, 4> outer_{};
    int count_ = 0;
  };

  template <typename K>
  static AwayFromTetrahedron away_from(
      const CGAL::Alpha_wraps_3::internal::Tetrahedron_with_outside_info<K>& given) {
    return AwayFromTetrahedron(given);
  }
  template <typename K>
  static AwayFromBall away_from(const CGAL::Alpha_wraps_3::internal::Ball_3<K>& ball) {
    return AwayFromBall(ball);
  }

  /// Finds out if any triangle meets the query: boxes in doubt are entered, as only triangles
  /// decide.
  template <typename Query>
  class Meeting {
   public:
    Meeting(const Query& query, const Traits& traits, Triangles& triangles)
        : away_(away_from(query)), traits_(&traits), triangles_(&triangles) {
      triangles.begin();
    }

    [[nodiscard]] bool go_further() const { return !found_; }
    void intersection(const Query& query, const Primitive& one) {
      if (triangles_->is_new(one.id().second)) found_ = traits_->do_intersect_object()(query, one);
    }
    [[nodiscard]] bool do_intersect(const Query& /*query*/, const Node& node) const {
      return !away_(node.bbox());
    }
    [[nodiscard]] bool is_found() const { return found_; }

   private:
    decltype(away_from(std::declval<const Query&>())) away_;
    const Traits* traits_;
    Triangles* triangles_;
    bool found_ = false;
  };

  /// The nearest point of all: a triangle more might be as near, so boxes in doubt are asked
  /// exactly.
  class Nearest {
   public:
    Nearest(const Point& query, const Point& hint, const Traits& traits, Triangles& triangles)
        : traits_(&traits), triangles_(&triangles) {
      triangles.begin();
      take(query, hint);
    }

    [[nodiscard]] bool go_further() const { return true; }
    void intersection(const Point& query, const Primitive& one) {
      if (!triangles_->is_new(one.id().second)) return;
      take(query, traits_->closest_point_object()(query, one, point_));
    }
    [[nodiscard]] bool do_intersect(const Point& query, const Node& node) const {
      const double squared = WrapOracle::squared_to_box(query, node.bbox());
      if (squared < squared_ * (1 - doubtful)) return true;
      if (squared > squared_ * (1 + doubtful)) return false;
      return traits_->compare_distance_object()(query, node.bbox(), point_) == CGAL::SMALLER;
    }
    [[nodiscard]] const Point& point() const { return point_; }

   private:
    void take(const Point& query, const Point& point) {
      point_ = point;
      squared_ = CGAL::squared_distance(query, point);
    }

    Point point_;
    double squared_ = 0;
    const Traits* traits_;
    Triangles* triangles_;
  };

  std::shared_ptr<Triangles> triangles_ = std::make_shared<Triangles>();  // CGAL copies oracles
};

}  // namespace curveskel
