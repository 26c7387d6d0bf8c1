#include "skeleton/embed/place/mirror.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

/// A curve with its radii, by the share of its length.
class CurveByLength {
 public:
  CurveByLength() = default;
  CurveByLength(const SkeletonGraph& graph, const Arc& arc, const SurfaceTree& tree)
      : places_(graph.polyline(arc)), radii_(graph.radii_along(arc, tree)) {
    shares_.assign(places_.size(), 0);
    for (std::size_t i = 1; i < places_.size(); ++i) {
      shares_[i] = shares_[i - 1] + (places_[i] - places_[i - 1]).norm();
    }
    const double length = shares_.back();
    for (std::size_t i = 1; i < places_.size(); ++i) {
      shares_[i] = length > 0 ? shares_[i] / length : double(i) / double(places_.size() - 1);
    }
  }

  struct Ball {
    Point centre;
    double radius;
  };
  [[nodiscard]] Ball at(double share) const {
    const auto after = std::lower_bound(shares_.begin() + 1, shares_.end() - 1, share);
    const auto i = static_cast<std::size_t>(after - shares_.begin());
    const double span = shares_[i] - shares_[i - 1];
    const double part = span > 0 ? std::clamp((share - shares_[i - 1]) / span, 0.0, 1.0) : 0;
    return {places_[i - 1] + part * (places_[i] - places_[i - 1]),
            radii_[i - 1] + part * (radii_[i] - radii_[i - 1])};
  }
  [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

 private:
  std::vector<Point> places_;
  std::vector<double> radii_;
  std::vector<double> shares_;
};

class Mirroring {
 public:
  Mirroring(SkeletonGraph& graph, int axis, const SurfaceTree& tree, double keep)
      : graph_(graph), axis_(axis), tree_(tree), keep_(keep) {
    find_image_nodes();
    for (const Arc& arc : graph_.arcs) {
      courses_.push_back(arc.alive ? CurveByLength(graph_, arc, tree_) : CurveByLength());
    }
  }

  int run() {
    std::vector<Pair> pairs = overlapping_pairs();
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    std::vector<char> taken(graph_.arcs.size(), 0);
    std::vector<Pair> chosen;
    for (const Pair& pair : pairs) {
      if (taken[idx(pair.arc)] != 0 || taken[idx(pair.image)] != 0) continue;
      taken[idx(pair.arc)] = taken[idx(pair.image)] = 1;
      chosen.push_back(pair);
    }
    move_nodes(chosen);
    int moved = 0;
    for (const Pair& pair : chosen) moved += move_arcs(pair) ? 1 : 0;
    return moved;
  }

 private:
  struct Pair {
    int arc;
    int image;
    bool turned;      ///< the image runs the other way
    double distance;  ///< the mean, in units of the radii there
  };

  [[nodiscard]] Point reflected(Point place) const {
    place[axis_] = -place[axis_];
    return place;
  }

  /// Those that are the nearest to each other's images, of the same degree.
  void find_image_nodes() {
    const auto nearest = [&](int node) {
      const Point image = reflected(graph_.place(node));
      double least = std::numeric_limits<double>::infinity();
      int best = -1;
      for (int other = 0; other < static_cast<int>(graph_.nodes.size()); ++other) {
        if (!graph_.nodes[idx(other)].alive || graph_.degree(other) != graph_.degree(node)) {
          continue;
        }
        const double square = (graph_.place(other) - image).squaredNorm();
        if (square < least) {
          least = square;
          best = other;
        }
      }
      return best;
    };
    image_node_.assign(graph_.nodes.size(), -1);
    for (int node = 0; node < static_cast<int>(graph_.nodes.size()); ++node) {
      if (graph_.nodes[idx(node)].alive) image_node_[idx(node)] = nearest(node);
    }
    const std::vector<int> nearest_of = image_node_;
    for (std::size_t node = 0; node < nearest_of.size(); ++node) {
      const int image = nearest_of[node];
      if (image >= 0 && nearest_of[idx(image)] != static_cast<int>(node)) image_node_[node] = -1;
    }
  }

  [[nodiscard]] std::vector<Pair> overlapping_pairs() const {
    std::vector<Pair> pairs;
    for (int arc = 0; arc < static_cast<int>(graph_.arcs.size()); ++arc) {
      const Arc& one = graph_.arcs[idx(arc)];
      if (!one.alive || image_node_[idx(one.from)] < 0 || image_node_[idx(one.to)] < 0) continue;
      const auto add = [&](int image, bool turned) {
        if (image == arc && !may_be_own_image(one, turned)) return;
        const double distance = distance_between(arc, image, turned);
        if (distance <= 1) pairs.push_back({arc, image, turned, distance});
      };
      for (const int image : graph_.nodes[idx(image_node_[idx(one.from)])].arcs) {
        const Arc& other = graph_.arcs[idx(image)];
        if (image < arc) continue;
        if (other.from == image_node_[idx(one.from)] && other.to == image_node_[idx(one.to)]) {
          add(image, false);
        }
        if (other.to == image_node_[idx(one.from)] && other.from == image_node_[idx(one.to)]) {
          add(image, true);
        }
      }
    }
    return pairs;
  }

  /// In the plane, or if turned across it, to within 30 degrees from end to end: in a fat body any
  /// line is near to its image.
  [[nodiscard]] bool may_be_own_image(const Arc& arc, bool turned) const {
    const Point chord = graph_.place(arc.to) - graph_.place(arc.from);
    const double across = std::abs(chord[axis_]);
    const double along = std::sqrt(std::max(0.0, chord.squaredNorm() - across * across));
    return turned ? 3 * along * along <= across * across : 3 * across * across <= along * along;
  }

  /// Over the sum of the radii: 1 where the balls touch each other's images in the mean.
  [[nodiscard]] double distance_between(int arc, int image, bool turned) const {
    constexpr int samples = 16;
    double apart = 0;
    double reach = 0;
    for (int i = 0; i <= samples; ++i) {
      const double share = double(i) / samples;
      const auto ball = courses_[idx(arc)].at(share);
      const auto other = courses_[idx(image)].at(turned ? 1 - share : share);
      apart += (ball.centre - reflected(other.centre)).norm();
      reach += std::max(ball.radius, 0.0) + std::max(other.radius, 0.0);
    }
    return reach > 0 ? apart / reach : std::numeric_limits<double>::infinity();
  }

  /// Only those with an arc that has an image.
  void move_nodes(const std::vector<Pair>& chosen) {
    std::vector<char> ends(graph_.nodes.size(), 0);
    for (const Pair& pair : chosen) {
      for (const int arc : {pair.arc, pair.image}) {
        ends[idx(graph_.arcs[idx(arc)].from)] = ends[idx(graph_.arcs[idx(arc)].to)] = 1;
      }
    }
    for (int node = 0; node < static_cast<int>(graph_.nodes.size()); ++node) {
      const int image = image_node_[idx(node)];
      if (ends[idx(node)] == 0 || image < node) continue;
      const Point place = 0.5 * (graph_.place(node) + reflected(graph_.place(image)));
      const std::array<CurvePoint, 2> moved{place, reflected(place)};
      if (!keeps_radius(moved[0], graph_.nodes[idx(node)].point.radius(tree_)) ||
          !keeps_radius(moved[1], graph_.nodes[idx(image)].point.radius(tree_))) {
        continue;
      }
      graph_.nodes[idx(node)].point = moved[0];
      if (image != node) graph_.nodes[idx(image)].point = moved[1];
    }
  }

  [[nodiscard]] bool keeps_radius(const CurvePoint& moved, double before) const {
    return moved.radius(tree_) >= keep_ * before;
  }

  bool move_arcs(const Pair& pair) {
    const CurveByLength& course = courses_[idx(pair.arc)];
    const CurveByLength& other = courses_[idx(pair.image)];
    const bool own_turned = pair.turned && pair.arc == pair.image;
    const std::vector<double>& shares = course.shares();
    std::vector<CurvePoint> points;
    std::vector<CurvePoint> images;
    for (std::size_t i = 1; i + 1 < shares.size(); ++i) {
      const double share =
          own_turned ? 0.5 * (shares[i] + 1 - shares[shares.size() - 1 - i]) : shares[i];
      const CurveByLength::Ball here = course.at(share);
      const auto there = other.at(pair.turned ? 1 - share : share);
      const Point place = 0.5 * (here.centre + reflected(there.centre));
      points.emplace_back(place);
      images.emplace_back(reflected(place));
      if (!keeps_radius(points.back(), here.radius)) return false;
      if (!keeps_radius(images.back(), there.radius)) return false;
    }
    graph_.arcs[idx(pair.arc)].points = std::move(points);
    if (pair.image == pair.arc) return true;
    if (pair.turned) std::reverse(images.begin(), images.end());
    graph_.arcs[idx(pair.image)].points = std::move(images);
    return true;
  }

  SkeletonGraph& graph_;
  int axis_;
  const SurfaceTree& tree_;
  double keep_;
  std::vector<int> image_node_;         // -1 = none
  std::vector<CurveByLength> courses_;  // per arc
};

}  // namespace

std::vector<MirrorPlane> mirror_planes(const Surface& surface, const SurfaceTree& tree,
                                       double tolerance, int threads) {
  constexpr Eigen::Index fewest = 10;  // one in so many vertices may have its image elsewhere
  const Eigen::Index count = surface.positions.rows();
  std::vector<MirrorPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    std::atomic<Eigen::Index> elsewhere{0};
    constexpr std::size_t grain = 256;
    parallel_for(idx(count), grain, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end && elsewhere * fewest <= count; ++v) {
        Point image = surface.positions.row(static_cast<Eigen::Index>(v)).transpose();
        image[axis] = -image[axis];
        if (tree.nearest(image, tolerance).triangle < 0) ++elsewhere;
      }
    });
    if (elsewhere * fewest <= count) planes.push_back({axis, elsewhere == 0});
  }
  return planes;
}

int mirror_arcs(SkeletonGraph& graph, int axis, const SurfaceTree& tree, double keep) {
  return Mirroring(graph, axis, tree, keep).run();
}

}  // namespace curveskel
