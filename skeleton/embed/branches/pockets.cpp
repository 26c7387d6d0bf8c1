#include "skeleton/embed/branches/pockets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

struct Pocket {
  std::size_t pieces = 0;  ///< of those from the tip on; 0 = none
  Point rim = Point::Zero();
  Point bottom = Point::Zero();
};

/// The surface from a tip on, taken group by group.
class PocketSearch {
 public:
  PocketSearch(const WorkingSurface& working, const PartitionGraph& partition, double limit)
      : working_(working),
        partition_(partition),
        limit_(limit),
        vertices_(idx(partition.groups)),
        taken_(idx(partition.groups), 0) {
    for (int v = 0; v < working.vertices(); ++v) {
      vertices_[idx(partition.group_of_vertex[v])].push_back(v);
    }
  }

  /// The pocket that the first of the pieces, which are a tip's and its arc's in order, form.
  [[nodiscard]] Pocket pocket(const std::vector<int>& pieces) {
    std::size_t best = 0;
    double least = 0;
    six_volumes_ = 0;
    two_areas_.setZero();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i] < partition_.groups) {
        take(pieces[i]);
        continue;
      }
      const double volume = six_volumes_ - rim(pieces[i]).centre.dot(two_areas_);
      if (volume >= least) continue;
      least = volume;
      best = i + 1;
    }
    for (const int piece : pieces) {
      if (piece < partition_.groups) taken_[idx(piece)] = 0;
    }
    return best > 0 ? hollow(pieces, best) : Pocket();
  }

 private:
  struct Rim {
    Point centre = Point::Zero();
    double radius = 0;  ///< mean distance from the centre
  };

  [[nodiscard]] Rim rim(int piece) const {
    const auto& crossed = partition_.cut_curves[idx(piece - partition_.groups)];
    const auto count = static_cast<double>(crossed.size());
    const auto middle = [this](const std::array<int, 2>& edge) -> Point {
      return (working_.place(edge[0]) + working_.place(edge[1])) / 2;
    };
    Rim found;
    for (const auto& edge : crossed) found.centre += middle(edge) / count;
    for (const auto& edge : crossed) found.radius += (middle(edge) - found.centre).norm() / count;
    return found;
  }

  /// Adds the triangles of a group, and those between it and groups taken before.
  void take(int group) {
    taken_[idx(group)] = 1;
    const auto& triangles_around = working_.triangles_around();
    for (const int v : vertices_[idx(group)]) {
      const auto first = idx(triangles_around.offsets[idx(v)]);
      const auto end = idx(triangles_around.offsets[idx(v) + 1]);
      for (std::size_t k = first; k < end; ++k) add(triangles_around.values[k], v, group);
    }
  }

  void add(int triangle, int vertex, int group) {
    const auto corners = working_.surface().triangles.row(triangle);
    const auto group_of = [this](int v) { return partition_.group_of_vertex[v]; };
    for (const int corner : corners) {
      if (taken_[idx(group_of(corner))] == 0) return;
    }
    const auto counted = std::find_if(corners.begin(), corners.end(),
                                      [&](int corner) { return group_of(corner) == group; });
    if (*counted != vertex) return;
    const Point a = working_.place(corners[0]);
    const Point b = working_.place(corners[1]);
    const Point c = working_.place(corners[2]);
    six_volumes_ += a.dot(b.cross(c));
    two_areas_ += a.cross(b) + b.cross(c) + c.cross(a);
  }

  /// Made of the first pieces; none if they stick out too little.
  [[nodiscard]] Pocket hollow(const std::vector<int>& pieces, std::size_t count) const {
    const Rim found = rim(pieces[count - 1]);
    Point bottom = found.centre;
    double depth = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (pieces[i] >= partition_.groups) continue;
      for (const int v : vertices_[idx(pieces[i])]) {
        const double distance = (working_.place(v) - found.centre).norm();
        if (distance <= depth) continue;
        depth = distance;
        bottom = working_.place(v);
      }
    }
    if (depth < limit_ * found.radius) return {};
    return {count, found.centre, bottom};
  }

  const WorkingSurface& working_;
  const PartitionGraph& partition_;
  double limit_;
  std::vector<std::vector<int>> vertices_;  // per group
  std::vector<char> taken_;                 // per group
  double six_volumes_ = 0;                  // of the tetrahedra from the origin
  Point two_areas_ = Point::Zero();
};

/// Those of a tip and its arc, in order; the arc itself keeps its direction.
std::vector<int> pieces_from(const SkeletonGraph& graph, int tip) {
  std::vector<int> pieces = graph.nodes[idx(tip)].pieces;
  const Arc& arc = graph.arcs[idx(graph.nodes[idx(tip)].arcs.front())];
  if (arc.from == tip) {
    pieces.insert(pieces.end(), arc.pieces.begin(), arc.pieces.end());
  } else {
    pieces.insert(pieces.end(), arc.pieces.rbegin(), arc.pieces.rend());
  }
  return pieces;
}

/// True if the curve that stays passes the bottom at less than the pocket's depth: it leads back
/// along the limb that it ends. In the wall of a larger hollow, or where the surface crosses
/// itself, it does not.
bool leads_back(const SkeletonGraph& graph, int tip, const Pocket& pocket) {
  const double depth = (pocket.bottom - pocket.rim).norm();
  const auto is_near = [&](const CurvePoint& p) {
    return (p.place() - pocket.bottom).norm() < depth;
  };
  const int leaf = graph.nodes[idx(tip)].arcs.front();
  const Arc& its = graph.arcs[idx(leaf)];
  const Node& base = graph.nodes[idx(its.from == tip ? its.to : its.from)];
  if (is_near(base.point)) return true;
  for (const int s : base.arcs) {
    std::span<const CurvePoint> points = graph.arcs[idx(s)].points;
    if (s == leaf) {
      const std::size_t gone = pocket.pieces - graph.nodes[idx(tip)].pieces.size();
      const std::size_t stay = points.size() - std::min(points.size(), gone);
      points = its.from == tip ? points.last(stay) : points.first(stay);
    }
    if (std::any_of(points.begin(), points.end(), is_near)) return true;
  }
  return false;
}

/// The arc loses its first pieces, all of the tip's among them, to what comes next.
void cut_back(SkeletonGraph& graph, int s, int tip, std::size_t count) {
  graph.orient_from(s, tip);
  Arc& arc = graph.arcs[idx(s)];
  Node& end = graph.nodes[idx(tip)];
  const std::size_t gone = count - end.pieces.size();
  if (gone >= arc.pieces.size()) {
    if (graph.is_leaf(arc)) graph.take_off(s);
    return;
  }
  const auto last = static_cast<std::ptrdiff_t>(gone);
  end.point = arc.points[gone];
  end.pieces.insert(end.pieces.end(), arc.pieces.begin(), arc.pieces.begin() + last + 1);
  arc.pieces.erase(arc.pieces.begin(), arc.pieces.begin() + last + 1);
  arc.points.erase(arc.points.begin(), arc.points.begin() + last + 1);
}

}  // namespace

void cut_pockets(SkeletonGraph& graph, const WorkingSurface& working,
                 const PartitionGraph& partition, double limit) {
  PocketSearch search(working, partition, limit);
  const auto nodes = static_cast<int>(graph.nodes.size());
  std::vector<std::size_t> pockets(idx(nodes), 0);
  for (int tip = 0; tip < nodes; ++tip) {
    if (graph.degree(tip) != 1) continue;
    const Pocket found = search.pocket(pieces_from(graph, tip));
    if (found.pieces > 0 && leads_back(graph, tip, found)) pockets[idx(tip)] = found.pieces;
  }
  for (int tip = 0; tip < nodes; ++tip) {
    if (pockets[idx(tip)] == 0 || graph.degree(tip) != 1) continue;
    cut_back(graph, graph.nodes[idx(tip)].arcs.front(), tip, pockets[idx(tip)]);
  }
}

}  // namespace curveskel
