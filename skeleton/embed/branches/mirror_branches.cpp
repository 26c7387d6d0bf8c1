#include "skeleton/embed/branches/mirror_branches.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/arc_projection.hpp"
#include "surface/spatial/segment.hpp"

namespace curveskel {
namespace {

struct GraphPlace {
  double distance = std::numeric_limits<double>::infinity();
  int arc = -1;
  std::size_t segment = 0;
  Point place = Point::Zero();
};

/// The nearest place of all arcs but one.
GraphPlace nearest_place(const SkeletonGraph& graph, const Point& point, int but = -1) {
  GraphPlace best;
  for (int arc = 0; arc < static_cast<int>(graph.arcs.size()); ++arc) {
    if (!graph.arcs[idx(arc)].alive || arc == but) continue;
    const std::vector<Point> line = graph.polyline(graph.arcs[idx(arc)]);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point place = nearest_on_segment(point, line[k], line[k + 1]);
      const double distance = (place - point).norm();
      if (distance < best.distance) best = {distance, arc, k, place};
    }
  }
  return best;
}

class MirroredBranches {
 public:
  MirroredBranches(SkeletonGraph& graph, int axis, const WorkingSurface& working,
                   const SurfaceTree& tree, const PartitionGraph& partition)
      : graph_(graph), axis_(axis), working_(working), tree_(tree), partition_(partition) {}

  int run() {
    int added = 0;
    const auto count = static_cast<int>(graph_.arcs.size());
    for (int arc = 0; arc < count; ++arc) {
      if (graph_.is_leaf(graph_.arcs[idx(arc)]) && lacks_image(arc) && add_image(arc)) ++added;
    }
    return added + merge_lone_junctions();
  }

 private:
  [[nodiscard]] Point reflected(Point place) const {
    place[axis_] = -place[axis_];
    return place;
  }

  [[nodiscard]] int tip_of(int arc) const {
    const Arc& leaf = graph_.arcs[idx(arc)];
    return graph_.degree(leaf.from) == 1 ? leaf.from : leaf.to;
  }

  /// The junction that has the image in its ball's image; -1 if there is none.
  [[nodiscard]] int image_of(int junction) const {
    const Point image = reflected(graph_.place(junction));
    const double radius = graph_.nodes[idx(junction)].point.radius(tree_);
    for (int other = 0; other < static_cast<int>(graph_.nodes.size()); ++other) {
      if (!graph_.nodes[idx(other)].alive || graph_.degree(other) < 3) continue;
      if ((graph_.place(other) - image).norm() < radius) return other;
    }
    return -1;
  }

  int merge_lone_junctions() {
    int merged = 0;
    for (int node = 0; node < static_cast<int>(graph_.nodes.size()); ++node) {
      const bool is_junction = graph_.nodes[idx(node)].alive && graph_.degree(node) >= 3;
      if (!is_junction || image_of(node) >= 0) continue;
      const int arc = only_way_on(node);
      if (arc < 0 || !passes_by(node, arc)) continue;
      merge_along(arc, node);
      ++merged;
    }
    return merged;
  }

  /// From a junction of leaves to the next; -1 where there is no such arc.
  [[nodiscard]] int only_way_on(int junction) const {
    int way_on = -1;
    for (const int arc : graph_.nodes[idx(junction)].arcs) {
      if (graph_.is_leaf(graph_.arcs[idx(arc)])) continue;
      if (way_on >= 0) return -1;
      way_on = arc;
    }
    return way_on;
  }

  /// On the other side a leaf from the image of the way's end runs through that of the ball.
  [[nodiscard]] bool passes_by(int junction, int way_on) const {
    const Arc& way = graph_.arcs[idx(way_on)];
    const int image = image_of(way.from == junction ? way.to : way.from);
    if (image < 0 || image == junction) return false;
    const GraphPlace near = nearest_place(graph_, reflected(graph_.place(junction)));
    const Arc& other = graph_.arcs[idx(near.arc)];
    return near.distance < graph_.nodes[idx(junction)].point.radius(tree_) &&
           graph_.is_leaf(other) && (other.from == image || other.to == image);
  }

  /// The arcs at the junction go on along this one.
  void merge_along(int arc, int junction) {
    graph_.orient_from(arc, junction);
    const Arc way = graph_.arcs[idx(arc)];
    std::vector<CurvePoint> shared(way.points.rbegin(), way.points.rend());
    shared.push_back(graph_.nodes[idx(junction)].point);
    const std::vector<int> arcs = graph_.nodes[idx(junction)].arcs;
    for (const int other : arcs) {
      if (other == arc) continue;
      graph_.orient_from(other, junction);
      std::vector<CurvePoint>& points = graph_.arcs[idx(other)].points;
      points.insert(points.begin(), shared.begin(), shared.end());
    }
    graph_.collapse(arc, way.to, graph_.nodes[idx(way.to)].point);
  }

  [[nodiscard]] bool lacks_image(int arc) const {
    const Point& tip = graph_.place(tip_of(arc));
    const Point image = reflected(tip);
    const double apart = (image - tip).norm();
    const bool is_own = !(apart > 0) || tree_.ray(tip, (image - tip) / apart, apart).triangle < 0;
    if (is_own) return false;
    const double own = nearest_place(graph_, tip, arc).distance;
    return 2 * nearest_place(graph_, image).distance > own;
  }

  /// The image of each point keeps half of the radius: a sword in one hand has no image.
  [[nodiscard]] bool lies_inside(int arc) const {
    const std::vector<CurvePoint> points = graph_.points_along(graph_.arcs[idx(arc)], tree_);
    return std::all_of(points.begin(), points.end(), [&](const CurvePoint& point) {
      return 2 * tree_.inscribed_radius(reflected(point.place())) >= point.radius(tree_);
    });
  }

  /// -1 if no place of the graph is near enough.
  [[nodiscard]] int image_node(const Point& base, double radius) {
    int best = -1;
    double least = radius;
    for (int node = 0; node < static_cast<int>(graph_.nodes.size()); ++node) {
      if (!graph_.nodes[idx(node)].alive || graph_.degree(node) == 1) continue;
      const double distance = (graph_.place(node) - base).norm();
      if (distance > least) continue;
      least = distance;
      best = node;
    }
    if (best >= 0) return best;
    const GraphPlace near = nearest_place(graph_, base);
    if (near.distance > radius) return -1;
    return graph_.split(near.arc, near.segment, near.place);
  }

  bool add_image(int arc) {
    if (!lies_inside(arc)) return false;
    const Arc leaf = graph_.arcs[idx(arc)];
    const int tip = tip_of(arc);
    const int base = tip == leaf.from ? leaf.to : leaf.from;
    const int from =
        image_node(reflected(graph_.place(base)), graph_.nodes[idx(base)].point.radius(tree_));
    if (from < 0) return false;
    const auto projections = project_on_arcs(graph_, working_, partition_, 1);
    const int end =
        graph_.add_leaf(from, reflected(graph_.place(tip)),
                        groups_on(graph_.nodes[idx(from)].arcs, projections, partition_));
    std::vector<CurvePoint> points;
    points.reserve(leaf.points.size());
    for (const CurvePoint& point : leaf.points) points.emplace_back(reflected(point.place()));
    if (tip == leaf.from) std::reverse(points.begin(), points.end());
    graph_.arcs[idx(graph_.nodes[idx(end)].arcs.front())].points = std::move(points);
    return true;
  }

  SkeletonGraph& graph_;
  int axis_;
  const WorkingSurface& working_;
  const SurfaceTree& tree_;
  const PartitionGraph& partition_;
};

}  // namespace

int mirror_branches(SkeletonGraph& graph, int axis, const WorkingSurface& working,
                    const SurfaceTree& tree, const PartitionGraph& partition) {
  return MirroredBranches(graph, axis, working, tree, partition).run();
}

}  // namespace curveskel
