#include "skeleton/homology/reroute.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "skeleton/certify/curve_samples.hpp"
#include "skeleton/embed/contain/ball_chains.hpp"
#include "skeleton/embed/contain/below_surface.hpp"
#include "skeleton/homology/homology_classes.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {
namespace {

/// From ball centre to ball centre of vertices, but just below the surface where two lie on
/// different sides of a tunnel.
class InnerCurves {
 public:
  InnerCurves(const WorkingSurface& working, const SurfaceTree& tree, HomologyGuard& guard)
      : below_(working), tree_(tree), balls_(working.balls()), guard_(guard) {}

  [[nodiscard]] const BelowSurface& below() const { return below_; }

  /// Each vertex is the next one's neighbour. Balls that are as good as outside are passed below
  /// the surface.
  [[nodiscard]] std::vector<Point> deep(const std::vector<int>& vertices) const {
    std::vector<Point> points;
    const auto centre = [this](int v) -> Point { return balls_.centres.row(v); };
    const auto has_ball = [this](int v) { return balls_.radii[v] > least_radius; };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int here = vertices[i];
      const int before = i == 0 ? -1 : vertices[i - 1];
      if (here == before) continue;
      if (before >= 0) {
        const Point from = centre(before);
        const Point to = centre(here);
        const auto step = below_.step(before, here);
        if (!has_ball(before) || !has_ball(here) || crosses(tree_, from, to) ||
            !guard_.homologous(step, {from, to})) {
          points.insert(points.end(), step.begin(), step.end());
        }
      }
      if (has_ball(here)) points.push_back(centre(here));
    }
    return points;
  }

 private:
  BelowSurface below_;
  const SurfaceTree& tree_;
  const InscribedBalls& balls_;
  HomologyGuard& guard_;
};

class HandleReroute {
 public:
  HandleReroute(SkeletonGraph& graph, const WorkingSurface& working, const SurfaceTree& tree,
                const PartitionGraph& partition, HomologyGuard& guard)
      : graph_(graph),
        partition_(partition),
        guard_(guard),
        curves_(working, tree, guard),
        chains_(working, partition),
        middle_(graph.nodes.size(), -1) {}

  void run() {
    const auto tunnels = arcs_along_tunnels();
    for (const int s : core(graph_)) {
      guard_.hear_stop();
      if (!std::binary_search(tunnels.begin(), tunnels.end(), s)) reroute(graph_.arcs[idx(s)]);
    }
    std::vector<int> ends;
    ends.reserve(2 * tunnels.size());
    for (const int s : tunnels) {
      ends.push_back(graph_.arcs[idx(s)].from);
      ends.push_back(graph_.arcs[idx(s)].to);
    }
    for (const int s : tunnels) {
      guard_.hear_stop();
      end_in_ring_at_cut_curve(s);
    }
    for (const int node : ends) {
      if (!graph_.nodes[idx(node)].alive) continue;
      if (graph_.degree(node) == 2) graph_.dissolve(node);
      if (graph_.degree(node) == 1) graph_.prune(graph_.nodes[idx(node)].arcs.front());
    }
  }

 private:
  /// The part of an arc from its `from` to one of its cut curves.
  struct Half {
    std::vector<int> way;   // vertices, from the middle of the node
    int group = -1;         // the last one, before the cut curve
    std::size_t place = 0;  // of the cut curve, along the arc's pieces
  };

  [[nodiscard]] const std::vector<std::array<int, 2>>& edges_across(int cut_curve) const {
    return partition_.cut_curves[idx(cut_curve - partition_.groups)];
  }

  [[nodiscard]] int end_in(int group, const std::array<int, 2>& edge) const {
    return partition_.group_of_vertex[edge[0]] == group ? edge[0] : edge[1];
  }

  /// The vertex on a group's side of the edge where a cut curve is crossed.
  [[nodiscard]] int gate(int cut_curve, int group) const {
    return end_in(group, edges_across(cut_curve).front());
  }

  /// Round a cut curve on a group's side, from the gate to the gate.
  [[nodiscard]] std::vector<int> ring(int cut_curve, int group) const {
    std::vector<int> vertices;
    for (const auto& edge : edges_across(cut_curve)) vertices.push_back(end_in(group, edge));
    vertices.push_back(vertices.front());
    return vertices;
  }

  /// The vertex in the middle of a node's group, the same for all its arcs.
  [[nodiscard]] int middle_of(int node) {
    const Node& given = graph_.nodes[idx(node)];
    int& middle = middle_[idx(node)];
    if (middle < 0) middle = chains_.nearest_vertex(given.point.place(), {given.pieces.front()});
    return middle;
  }

  /// Groups and cut curves from one end of the arc to the other, those of its nodes included.
  [[nodiscard]] std::vector<int> course(const Arc& arc) const {
    std::vector<int> pieces{graph_.nodes[idx(arc.from)].pieces.front()};
    pieces.insert(pieces.end(), arc.pieces.begin(), arc.pieces.end());
    pieces.push_back(graph_.nodes[idx(arc.to)].pieces.front());
    return pieces;
  }

  /// Vertices through the groups among the pieces given, which begin and end with one; empty if
  /// there is no way.
  [[nodiscard]] std::vector<int> way(int first, const std::vector<int>& pieces, int last) {
    std::vector<int> vertices;
    for (std::size_t i = 0; i < pieces.size(); i += 2) {
      const int in = i == 0 ? first : gate(pieces[i - 1], pieces[i]);
      const int out = i + 1 == pieces.size() ? last : gate(pieces[i + 1], pieces[i]);
      if (in < 0 || out < 0) return {};
      auto through = chains_.way(in, out, {pieces[i]});
      if (through.empty()) through = chains_.way_through_all(in, out, {pieces[i]});
      if (through.empty()) return {};
      vertices.insert(vertices.end(), through.begin(), through.end());
    }
    return vertices;
  }

  void reroute(Arc& arc) {
    const auto vertices = way(middle_of(arc.from), course(arc), middle_of(arc.to));
    const auto points = curves_.deep(vertices);
    if (points.size() < 2) return;
    graph_.nodes[idx(arc.from)].point = points.front();
    graph_.nodes[idx(arc.to)].point = points.back();
    arc.points.assign(points.begin() + 1, points.end() - 1);
  }

  /// Of the arcs that a spanning tree leaves over, with as few such cut curves as can be, those
  /// with cut curves independent inside; ascending.
  [[nodiscard]] std::vector<int> arcs_along_tunnels() const {
    const auto arcs = core(graph_);
    std::vector<std::vector<Point>> rings;
    rings.reserve(arcs.size());
    for (const int s : arcs) {
      rings.push_back(curves_.below().round(edges_across(graph_.arcs[idx(s)].pieces.front())));
    }
    const auto rows = guard_.linking_numbers(rings);
    const auto vanishes = [&](std::size_t i) {
      return std::all_of(rows[i].begin(), rows[i].end(), [](auto word) { return word == 0; });
    };
    std::vector<std::size_t> order(arcs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(), vanishes);
    UnionFind tree(static_cast<std::int64_t>(graph_.nodes.size()));
    IndependentRows independent;
    std::vector<int> found;
    for (const std::size_t i : order) {
      const Arc& arc = graph_.arcs[idx(arcs[i])];
      if (tree.unite(arc.from, arc.to)) continue;
      if (independent.add(rows[i])) found.push_back(arcs[i]);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// To the cut curve of the arc that is shortest.
  [[nodiscard]] Half half_of(const Arc& arc) {
    Half best;
    double shortest = std::numeric_limits<double>::infinity();
    const auto pieces = course(arc);
    for (std::size_t k = 1; k < pieces.size(); k += 2) {
      const double length = polyline_length(curves_.below().round(edges_across(pieces[k])));
      if (length >= shortest) continue;
      shortest = length;
      best.place = k - 1;
      best.group = pieces[k - 1];
    }
    const auto end = pieces.begin() + static_cast<std::ptrdiff_t>(best.place + 1);
    best.way =
        way(middle_of(arc.from), {pieces.begin(), end}, gate(arc.pieces[best.place], best.group));
    return best;
  }

  /// The arc ends at one of its cut curves, and a closed one goes round that.
  void end_in_ring_at_cut_curve(int s) {
    const auto half_from = [&](int node) {
      graph_.orient_from(s, node);
      return half_of(graph_.arcs[idx(s)]);
    };
    const int from = graph_.arcs[idx(s)].from;
    const int to = graph_.arcs[idx(s)].to;
    Half half = half_from(to);
    Half other = half_from(from);
    const auto length = [&](const Half& h) {
      return h.way.empty() ? std::numeric_limits<double>::infinity()
                           : polyline_length(curves_.deep(h.way));
    };
    if (length(other) <= length(half)) {
      std::swap(half, other);
    } else {
      graph_.orient_from(s, to);
    }
    if (half.way.empty()) return;
    const int cut_curve = graph_.arcs[idx(s)].pieces[half.place];
    auto way = curves_.deep(half.way);
    graph_.nodes[idx(graph_.arcs[idx(s)].from)].point = way.front();
    if (way.size() > 1) way.erase(way.begin());
    auto round = curves_.deep(ring(cut_curve, half.group));
    round.pop_back();
    graph_.end_in_ring(s, half.place, std::move(way), round);
  }

  SkeletonGraph& graph_;
  const PartitionGraph& partition_;
  const HomologyGuard& guard_;
  InnerCurves curves_;
  BallChains chains_;
  std::vector<int> middle_;  // per node
};

}  // namespace

void reroute_around_handles(SkeletonGraph& graph, const WorkingSurface& working,
                            const SurfaceTree& tree, const PartitionGraph& partition,
                            HomologyGuard& guard) {
  HandleReroute(graph, working, tree, partition, guard).run();
}

}  // namespace curveskel
