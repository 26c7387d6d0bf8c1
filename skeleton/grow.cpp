#include "skeleton/grow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "skeleton/hosts.hpp"
#include "skeleton/slenderness.hpp"
#include "surface/element_index.hpp"

namespace curveskel {
namespace {

constexpr int most_passes = 8;
constexpr std::size_t fewest_vertices = 8;
// In inscribed radii where the branch begins.
constexpr double least_branch = 1.5;
constexpr double least_extension = 2;
// At the summit: a crease is no limb, nor is the corner of a blunt end.
constexpr double least_branch_ball = 0.12;
constexpr double least_extension_ball = 0.25;
constexpr double most_ball = 1.2;  // a wider one is where the strand comes from
constexpr double least_extension_slenderness = 1.5;
/// The network does not enter a part while its vertices' places are this much nearer to the centre.
constexpr double within = 0.6;

struct Summit {
  int vertex = -1;
  int hub = -1;  // where the branch begins, -1 = at the vertex's host
  double slenderness = 0;
  Point tip = Point::Zero();
};

class Growth {
 public:
  Growth(Network& network, const Surface& surface, const SurfaceTree& tree,
         const InscribedBalls& balls, const VertexGraph& graph)
      : network_(network),
        surface_(surface),
        tree_(tree),
        balls_(balls),
        graph_(graph),
        sweep_(surface),
        hosts_(at(surface.positions.rows())),
        grown_(hosts_.size(), 0) {}

  int run(double limit) {
    int count = 0;
    for (int pass = 0; pass < most_passes; ++pass) {
      hosts_ = hosts_of_vertices(network_, surface_, balls_, graph_);
      const int before = count;
      touched_.clear();
      for (const Summit& summit : summits(limit)) count += grow(summit) ? 1 : 0;
      if (count == before) break;
    }
    return count;
  }

 private:
  [[nodiscard]] Point place(int v) const { return surface_.positions.row(v); }
  [[nodiscard]] double height(int v) const { return (place(v) - hosts_[at(v)].place).norm(); }

  /// The hub that stands for a place of a strand: the tip whose ball holds it, or the hub that is
  /// there; -1 if there is none.
  [[nodiscard]] int hub_at(const Host& host, double radius) const {
    const Strand& strand = network_.strands[at(host.strand)];
    for (const int hub : {strand.from, strand.to}) {
      const double distance = (network_.hubs[at(hub)].position - host.place).norm();
      if (distance == 0 || (network_.degree(hub) == 1 && distance <= radius)) return hub;
    }
    return -1;
  }

  [[nodiscard]] Standout standout(const Point& base, int summit) {
    const auto is_own = [&](int v) {
      return (hosts_[at(v)].place - base).norm() < within * (place(v) - base).norm();
    };
    return sweep_(base, summit, is_own, std::numeric_limits<double>::infinity(), fewest_vertices);
  }

  /// Vertices from which no edge leads farther away from the network.
  [[nodiscard]] std::vector<int> farthest_around() const {
    std::vector<char> lower(hosts_.size(), 0);
    for (const auto& t : surface_.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        const int a = t(k);
        const int b = t((k + 1) % 3);
        (height(a) < height(b) ? lower[at(a)] : lower[at(b)]) = 1;
      }
    }
    std::vector<int> vertices;
    for (int v = 0; v < static_cast<int>(hosts_.size()); ++v) {
      if (lower[at(v)] == 0 && hosts_[at(v)].strand >= 0 && grown_[at(v)] == 0) {
        vertices.push_back(v);
      }
    }
    return vertices;
  }

  /// The branch from a hub, or from the vertex's host where there is none; no vertex if there can
  /// be none.
  [[nodiscard]] Summit made(int v, int hub, const SurfaceTree::Ball& root, const Standout& found,
                            double least_slenderness, double least_ball) {
    if (found.slenderness < least_slenderness) return {};
    const Point inwards = found.rim_centre - place(v);
    const auto ball = tree_.inscribed_ball(place(v), inwards.normalized());
    const double share = ball.radius / root.radius;
    if (!(share > least_ball && share < most_ball)) return {};
    return {v, hub, found.slenderness, tip(found, root, ball.centre)};
  }

  /// In the middle of a blunt end, rather than in the corner where the summit is.
  [[nodiscard]] Point tip(const Standout& part, const SurfaceTree::Ball& root,
                          const Point& at_summit) const {
    constexpr double beyond = 1.1;  // of the radius where it begins: nearer by it would be a spur
    constexpr double least = 0.2;
    const Point outwards = part.crown_centre - part.rim_centre;
    if (!(outwards.norm() > 0) || !tree_.inside(part.rim_centre)) return at_summit;
    const Point direction = outwards.normalized();
    const double reach = tree_.ray(part.rim_centre, direction).distance;
    if (!std::isfinite(reach)) return at_summit;
    const Point end = part.rim_centre + reach * direction;
    const auto ball = tree_.inscribed_ball(end, -direction);
    const double off = beyond * root.radius;
    if (ball.radius < reach && (ball.centre - root.centre).norm() > off) return ball.centre;
    const Point nearer_the_end = root.centre + off * (end - root.centre).normalized();
    const bool fits = tree_.inscribed_radius(nearer_the_end) > least * root.radius;
    return fits ? nearer_the_end : at_summit;
  }

  [[nodiscard]] Summit extension(int v, int tip) {
    const Point& base = network_.hubs[at(tip)].position;
    const SurfaceTree::Ball root{base, tree_.inscribed_radius(base)};
    if ((place(v) - base).norm() < least_extension * root.radius) return {};
    return made(v, tip, root, standout(base, v), least_extension_slenderness, least_extension_ball);
  }

  [[nodiscard]] Summit branch(int v, int hub, double radius, double limit) {
    const Host& host = hosts_[at(v)];
    Standout best = standout(host.place, v);
    Point base = host.place;
    const Strand& strand = network_.strands[at(host.strand)];
    for (const int end : {strand.from, strand.to}) {
      const Point& junction = network_.hubs[at(end)].position;
      if (network_.degree(end) < 3) continue;
      if ((junction - host.place).norm() > least_branch * radius) continue;
      const Standout here = standout(junction, v);
      if (here.slenderness <= best.slenderness) continue;
      best = here;
      base = junction;
      hub = end;
    }
    return made(v, hub, {base, radius}, best, limit, least_branch_ball);
  }

  /// Those that deserve a branch, most slender first.
  [[nodiscard]] std::vector<Summit> summits(double limit) {
    std::vector<Summit> found;
    for (const int v : farthest_around()) {
      const double radius = tree_.inscribed_radius(hosts_[at(v)].place);
      if (height(v) < least_branch * radius) continue;
      const int hub = hub_at(hosts_[at(v)], radius);
      const bool extends = hub >= 0 && network_.degree(hub) == 1;
      const Summit summit = extends ? extension(v, hub) : branch(v, hub, radius, limit);
      if (summit.vertex >= 0) found.push_back(summit);
    }
    std::stable_sort(found.begin(), found.end(), [](const Summit& a, const Summit& b) {
      return a.slenderness > b.slenderness;
    });
    return found;
  }

  /// False if the strands there have changed since the hosts were found.
  bool grow(const Summit& summit) {
    const Host& host = hosts_[at(summit.vertex)];
    int base = summit.hub;
    std::vector<int> around{host.strand};
    if (base >= 0) {
      const auto& there = network_.hubs[at(base)].strands;
      around.insert(around.end(), there.begin(), there.end());
    }
    const auto is_around = [&](int s) {
      return std::find(around.begin(), around.end(), s) != around.end();
    };
    if (std::any_of(touched_.begin(), touched_.end(), is_around)) return false;
    std::vector<int> groups;
    for (std::size_t v = 0; v < hosts_.size(); ++v) {
      if (is_around(hosts_[v].strand)) groups.push_back(graph_.group_of_vertex[int(v)]);
    }
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    if (base < 0) base = network_.split(host.strand, host.segment, host.place);
    const int tip = network_.add_leaf(base, summit.tip, std::move(groups));
    grown_[at(summit.vertex)] = 1;
    touched_.insert(touched_.end(), around.begin(), around.end());
    touched_.push_back(network_.hubs[at(tip)].strands.front());
    return true;
  }

  Network& network_;
  const Surface& surface_;
  const SurfaceTree& tree_;
  const InscribedBalls& balls_;
  const VertexGraph& graph_;
  SlendernessSweep sweep_;
  std::vector<Host> hosts_;   // per vertex
  std::vector<char> grown_;   // per vertex: it has had its branch
  std::vector<int> touched_;  // strands, in this pass
};

}  // namespace

int grow_branches(Network& network, const Surface& surface, const SurfaceTree& tree,
                  const InscribedBalls& balls, const VertexGraph& graph, double limit) {
  return Growth(network, surface, tree, balls, graph).run(limit);
}

}  // namespace curveskel
