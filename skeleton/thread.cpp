#include "skeleton/thread.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "skeleton/ball_chains.hpp"
#include "skeleton/below_surface.hpp"
#include "skeleton/curve_samples.hpp"
#include "skeleton/handle_keeper.hpp"
#include "skeleton/linking.hpp"
#include "surface/element_index.hpp"

namespace curveskel {
namespace {

/// From ball centre to ball centre of vertices, but just below the surface where two lie on
/// different sides of a tunnel.
class InnerCurves {
 public:
  InnerCurves(const Surface& surface, const SurfaceTree& tree, const InscribedBalls& balls,
              HandleKeeper& keeper)
      : below_(surface), tree_(tree), balls_(balls), keeper_(keeper) {}

  [[nodiscard]] const BelowSurface& below() const { return below_; }

  /// Each vertex is the next one's neighbour.
  [[nodiscard]] std::vector<Point> deep(const std::vector<int>& vertices) const {
    std::vector<Point> points;
    const auto centre = [this](int v) -> Point { return balls_.centres.row(v); };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i > 0 && vertices[i] != vertices[i - 1]) {
        const Point from = centre(vertices[i - 1]);
        const Point to = centre(vertices[i]);
        const auto step = below_.step(vertices[i - 1], vertices[i]);
        if (crosses(tree_, from, to) || !keeper_.alike(step, {from, to})) {
          points.insert(points.end(), step.begin(), step.end());
        }
      }
      if (i == 0 || vertices[i] != vertices[i - 1]) points.push_back(centre(vertices[i]));
    }
    return points;
  }

 private:
  BelowSurface below_;
  const SurfaceTree& tree_;
  const InscribedBalls& balls_;
  HandleKeeper& keeper_;
};

class Threading {
 public:
  Threading(Network& network, const Surface& surface, const SurfaceTree& tree,
            const InscribedBalls& balls, const VertexGraph& graph, HandleKeeper& keeper)
      : network_(network),
        surface_(surface),
        graph_(graph),
        curves_(surface, tree, balls, keeper),
        chains_(surface, balls, graph),
        middle_(network.hubs.size(), -1) {}

  void run() {
    const auto tunnels = strands_along_tunnels();
    for (const int s : core(network_)) {
      if (!std::binary_search(tunnels.begin(), tunnels.end(), s)) thread(network_.strands[at(s)]);
    }
    std::vector<int> ends;
    ends.reserve(2 * tunnels.size());
    for (const int s : tunnels) {
      ends.push_back(network_.strands[at(s)].from);
      ends.push_back(network_.strands[at(s)].to);
    }
    for (const int s : tunnels) turn_round(s);
    for (const int hub : ends) {
      if (!network_.hubs[at(hub)].alive) continue;
      if (network_.degree(hub) == 2) network_.dissolve(hub);
      if (network_.degree(hub) == 1) network_.prune(network_.hubs[at(hub)].strands.front());
    }
  }

 private:
  /// The part of a strand from its `from` to one of its circles.
  struct Half {
    std::vector<int> way;   // vertices, from the middle of the hub
    int group = -1;         // the last one, before the circle
    std::size_t place = 0;  // of the circle, along the strand's nodes
  };

  [[nodiscard]] const std::vector<std::array<int, 2>>& edges_across(int circle) const {
    return graph_.circles[at(circle - graph_.groups)];
  }

  [[nodiscard]] int end_in(int group, const std::array<int, 2>& edge) const {
    return graph_.group_of_vertex[edge[0]] == group ? edge[0] : edge[1];
  }

  /// Where a circle is crossed, the vertex on a group's side.
  [[nodiscard]] int gate(int circle, int group) const {
    return end_in(group, edges_across(circle).front());
  }

  /// Round a circle on a group's side, from the gate to the gate.
  [[nodiscard]] std::vector<int> ring(int circle, int group) const {
    std::vector<int> vertices;
    for (const auto& edge : edges_across(circle)) vertices.push_back(end_in(group, edge));
    vertices.push_back(vertices.front());
    return vertices;
  }

  /// The vertex in the middle of a hub's group, the same for all its strands.
  [[nodiscard]] int middle_of(int hub) {
    const Hub& given = network_.hubs[at(hub)];
    int& middle = middle_[at(hub)];
    if (middle < 0) middle = chains_.nearest_vertex(given.position, {given.nodes.front()});
    return middle;
  }

  /// Groups and circles from one end of the strand to the other, those of its hubs included.
  [[nodiscard]] std::vector<int> course(const Strand& strand) const {
    std::vector<int> nodes{network_.hubs[at(strand.from)].nodes.front()};
    nodes.insert(nodes.end(), strand.nodes.begin(), strand.nodes.end());
    nodes.push_back(network_.hubs[at(strand.to)].nodes.front());
    return nodes;
  }

  /// Vertices through the groups among the nodes given, which begin and end with one; empty if
  /// there is no way.
  [[nodiscard]] std::vector<int> way(int first, const std::vector<int>& nodes, int last) {
    std::vector<int> vertices;
    for (std::size_t i = 0; i < nodes.size(); i += 2) {
      const int in = i == 0 ? first : gate(nodes[i - 1], nodes[i]);
      const int out = i + 1 == nodes.size() ? last : gate(nodes[i + 1], nodes[i]);
      if (in < 0 || out < 0) return {};
      const auto through = chains_.way(in, out, {nodes[i]});
      if (through.empty()) return {};
      vertices.insert(vertices.end(), through.begin(), through.end());
    }
    return vertices;
  }

  void thread(Strand& strand) {
    const auto vertices = way(middle_of(strand.from), course(strand), middle_of(strand.to));
    const auto points = curves_.deep(vertices);
    if (points.size() < 2) return;
    network_.hubs[at(strand.from)].position = points.front();
    network_.hubs[at(strand.to)].position = points.back();
    strand.points.assign(points.begin() + 1, points.end() - 1);
  }

  /// Of the strands that a spanning tree leaves over, with as few such circles as can be, those
  /// with circles independent inside; ascending.
  [[nodiscard]] std::vector<int> strands_along_tunnels() const {
    const auto strands = core(network_);
    std::vector<std::vector<Point>> rings;
    rings.reserve(strands.size());
    for (const int s : strands) {
      rings.push_back(curves_.below().round(edges_across(network_.strands[at(s)].nodes.front())));
    }
    const auto rows = linking_numbers(surface_, rings);
    const auto vanishes = [&](std::size_t i) {
      return std::all_of(rows[i].begin(), rows[i].end(), [](auto word) { return word == 0; });
    };
    std::vector<std::size_t> order(strands.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(), vanishes);
    std::vector<int> tree(network_.hubs.size());  // union-find
    std::iota(tree.begin(), tree.end(), 0);
    const auto root = [&](int hub) {
      while (tree[at(hub)] != hub) hub = tree[at(hub)] = tree[at(tree[at(hub)])];
      return hub;
    };
    IndependentRows independent;
    std::vector<int> found;
    for (const std::size_t i : order) {
      const Strand& strand = network_.strands[at(strands[i])];
      const int a = root(strand.from);
      const int b = root(strand.to);
      if (a != b) {
        tree[at(a)] = b;
      } else if (independent.add(rows[i])) {
        found.push_back(strands[i]);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// To the circle of the strand that is shortest.
  [[nodiscard]] Half half_of(const Strand& strand) {
    Half best;
    double shortest = std::numeric_limits<double>::infinity();
    const auto nodes = course(strand);
    for (std::size_t k = 1; k < nodes.size(); k += 2) {
      const double length = polyline_length(curves_.below().round(edges_across(nodes[k])));
      if (length >= shortest) continue;
      shortest = length;
      best.place = k - 1;
      best.group = nodes[k - 1];
    }
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(best.place + 1);
    best.way = way(middle_of(strand.from), {nodes.begin(), end},
                   gate(strand.nodes[best.place], best.group));
    return best;
  }

  /// The strand ends at one of its circles, and a closed one goes round that.
  void turn_round(int s) {
    const auto half_from = [&](int hub) {
      network_.orient_from(s, hub);
      return half_of(network_.strands[at(s)]);
    };
    const int from = network_.strands[at(s)].from;
    const int to = network_.strands[at(s)].to;
    Half half = half_from(to);
    Half other = half_from(from);
    const auto length = [&](const Half& h) {
      return h.way.empty() ? std::numeric_limits<double>::infinity()
                           : polyline_length(curves_.deep(h.way));
    };
    if (length(other) <= length(half)) {
      std::swap(half, other);
    } else {
      network_.orient_from(s, to);
    }
    if (half.way.empty()) return;
    const int circle = network_.strands[at(s)].nodes[half.place];
    auto way = curves_.deep(half.way);
    network_.hubs[at(network_.strands[at(s)].from)].position = way.front();
    if (way.size() > 1) way.erase(way.begin());
    auto round = curves_.deep(ring(circle, half.group));
    round.pop_back();
    network_.end_in_ring(s, half.place, std::move(way), std::move(round));
  }

  Network& network_;
  const Surface& surface_;
  const VertexGraph& graph_;
  InnerCurves curves_;
  BallChains chains_;
  std::vector<int> middle_;  // per hub
};

}  // namespace

void thread_through(Network& network, const Surface& surface, const SurfaceTree& tree,
                    const InscribedBalls& balls, const VertexGraph& graph, HandleKeeper& keeper) {
  Threading(network, surface, tree, balls, graph, keeper).run();
}

}  // namespace curveskel
