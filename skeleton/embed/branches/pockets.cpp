#include "skeleton/embed/branches/pockets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The surface from a tip on, taken group by group.
class PocketSearch {
 public:
  PocketSearch(const WorkingSurface& working, const SurfaceTree& tree,
               const PartitionGraph& partition, double limit)
      : working_(working),
        tree_(tree),
        partition_(partition),
        limit_(limit),
        vertices_(idx(partition.groups)),
        taken_at_(idx(partition.groups), not_taken) {
    for (int v = 0; v < working.vertices(); ++v) {
      vertices_[idx(partition.group_of_vertex[v])].push_back(v);
    }
  }

  /// How many of the pieces, which are a tip's and its arc's in order, form a pocket.
  [[nodiscard]] std::size_t pocket(const std::vector<int>& pieces) {
    std::size_t best = 0;
    double least = 0;
    six_volumes_ = 0;
    two_areas_.setZero();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i] < partition_.groups) {
        take(pieces[i], static_cast<int>(i));
        continue;
      }
      const double volume = six_volumes_ - rim(pieces[i]).centre.dot(two_areas_);
      if (volume >= least) continue;
      least = volume;
      best = i + 1;
    }
    for (const int piece : pieces) {
      if (piece < partition_.groups) taken_at_[idx(piece)] = not_taken;
    }
    return best > 0 && is_hollow(pieces, best) ? best : 0;
  }

 private:
  static constexpr int not_taken = -1;
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
  void take(int group, int order) {
    taken_at_[idx(group)] = order;
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
      if (taken_at_[idx(group_of(corner))] == not_taken) return;
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

  [[nodiscard]] bool is_hollow(const std::vector<int>& pieces, std::size_t count) const {
    const Rim found = rim(pieces[count - 1]);
    if (tree_.inside(found.centre)) return false;  // a sheet that crosses itself has no opening
    double height = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (pieces[i] >= partition_.groups) continue;
      for (const int v : vertices_[idx(pieces[i])]) {
        height = std::max(height, (working_.place(v) - found.centre).norm());
      }
    }
    return height >= limit_ * found.radius;
  }

  const WorkingSurface& working_;
  const SurfaceTree& tree_;
  const PartitionGraph& partition_;
  double limit_;
  std::vector<std::vector<int>> vertices_;  // per group
  std::vector<int> taken_at_;               // per group
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

/// The arc loses its first pieces, all of the tip's among them, to what comes next.
void cut_back(SkeletonGraph& graph, int s, int tip, std::size_t count) {
  graph.orient_from(s, tip);
  Arc& arc = graph.arcs[idx(s)];
  Node& end = graph.nodes[idx(tip)];
  const std::size_t gone = count - end.pieces.size();
  if (gone >= arc.pieces.size()) {
    if (graph.is_leaf(arc)) graph.prune(s);
    return;
  }
  const auto last = static_cast<std::ptrdiff_t>(gone);
  end.point = arc.points[gone];
  end.pieces.insert(end.pieces.end(), arc.pieces.begin(), arc.pieces.begin() + last + 1);
  arc.pieces.erase(arc.pieces.begin(), arc.pieces.begin() + last + 1);
  arc.points.erase(arc.points.begin(), arc.points.begin() + last + 1);
}

}  // namespace

void cut_pockets(SkeletonGraph& graph, const WorkingSurface& working, const SurfaceTree& tree,
                 const PartitionGraph& partition, double limit) {
  PocketSearch search(working, tree, partition, limit);
  const auto nodes = static_cast<int>(graph.nodes.size());
  std::vector<std::size_t> pockets(idx(nodes), 0);
  for (int tip = 0; tip < nodes; ++tip) {
    if (graph.degree(tip) == 1) pockets[idx(tip)] = search.pocket(pieces_from(graph, tip));
  }
  for (int tip = 0; tip < nodes; ++tip) {
    if (pockets[idx(tip)] == 0 || graph.degree(tip) != 1) continue;
    cut_back(graph, graph.nodes[idx(tip)].arcs.front(), tip, pockets[idx(tip)]);
  }
}

}  // namespace curveskel
