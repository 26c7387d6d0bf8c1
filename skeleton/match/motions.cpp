#include "skeleton/match/motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/match/branch_laying.hpp"
#include "skeleton/match/some_of.hpp"
#include "skeleton/measure/branch_curve.hpp"

namespace curveskel {
namespace {

/// Improves the motion of a node's surroundings, some vertices of a.
using Lay = std::function<void(Similarity&, const std::vector<int>&)>;

class Follower {
 public:
  /// Components with less than a share of the area are not laid: each goes with what it sits on.
  Follower(const MatchSide& a, const TipFeatures& of_a, const Similarity& core, double least_share,
           Lay lay)
      : a_(a),
        of_a_(of_a),
        core_(core),
        least_share_(least_share),
        lay_(std::move(lay)),
        vertices_(idx(a.skeleton.nodes.rows())),
        settled_(vertices_.size(), false) {
    for (int vertex = 0; vertex < a.skeleton.node_of_vertex.size(); ++vertex) {
      const int node = a.skeleton.node_of_vertex[vertex];
      if (node >= 0) vertices_[idx(node)].push_back(vertex);
    }
    motions_.of_node.assign(vertices_.size(), core);
  }

  NodeMotions follow() {
    std::vector<int> order(vertices_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [this](int i, int k) { return key(i) < key(k); });
    for (const int node : order) settle(node);
    return std::move(motions_);
  }

 private:
  /// Large components first, in each from the middle outwards.
  [[nodiscard]] std::tuple<double, int, double> key(int node) const {
    const int component = of_a_.component[idx(node)];
    return {-of_a_.area_share[idx(component)], component, of_a_.from_centre[idx(node)]};
  }

  void settle(int node) {
    Similarity motion = start_of(node);
    if (is_large(node)) lay_(motion, surroundings(node));
    motions_.of_node[idx(node)] = motion;
    settled_[idx(node)] = true;
  }

  [[nodiscard]] bool is_large(int node) const {
    return of_a_.area_share[idx(of_a_.component[idx(node)])] >= least_share_;
  }

  [[nodiscard]] Similarity start_of(int node) const {
    for (const int next : of_a_.graph.neighbours(node)) {
      if (settled_[idx(next)] && of_a_.from_centre[idx(next)] <= of_a_.from_centre[idx(node)]) {
        return motions_.of_node[idx(next)];
      }
    }
    int nearest = -1;
    double least = 0;
    for (int other = 0; other < of_a_.graph.nodes(); ++other) {
      if (!settled_[idx(other)] || !is_large(other)) continue;
      const double distance =
          (a_.skeleton.nodes.row(other) - a_.skeleton.nodes.row(node)).squaredNorm();
      if (nearest >= 0 && distance >= least) continue;
      nearest = other;
      least = distance;
    }
    return nearest < 0 ? core_ : motions_.of_node[idx(nearest)];
  }

  /// Vertices of the nodes within two radii along the curve.
  [[nodiscard]] std::vector<int> surroundings(int node) {
    constexpr std::size_t most = 80;
    const double reach = 2 * std::max(0.0, a_.skeleton.radii[node]);
    std::vector<int> near;
    std::vector<std::pair<int, double>> open{{node, 0.0}};
    std::vector<int> seen{node};
    while (!open.empty()) {
      const auto [at, far] = open.back();
      open.pop_back();
      near.insert(near.end(), vertices_[idx(at)].begin(), vertices_[idx(at)].end());
      for (const int next : of_a_.graph.neighbours(at)) {
        const double there = far + (a_.skeleton.nodes.row(next) - a_.skeleton.nodes.row(at)).norm();
        if (there > reach || std::find(seen.begin(), seen.end(), next) != seen.end()) continue;
        seen.push_back(next);
        open.emplace_back(next, there);
      }
    }
    std::sort(near.begin(), near.end());
    return evenly(near, most);
  }

  const MatchSide& a_;
  const TipFeatures& of_a_;
  const Similarity& core_;
  double least_share_;
  Lay lay_;
  std::vector<std::vector<int>> vertices_;  ///< per node
  std::vector<bool> settled_;
  NodeMotions motions_;
};

}  // namespace

NodeMotions follow_motions(const MatchSide& a, const TipFeatures& of_a, const SurfaceTree& tree_b,
                           const Similarity& core) {
  const auto lay = [&](Similarity& motion, const std::vector<int>& vertices) {
    constexpr int rounds = 4;
    constexpr std::size_t least_points = 12;
    if (vertices.size() < least_points) return;
    refine(motion, a.surface.positions(vertices, Eigen::all).transpose(), tree_b, rounds);
  };
  return Follower(a, of_a, core, least_body_share, lay).follow();
}

NodeMotions known_motions(const MatchSide& a, const TipFeatures& of_a, const MatchSide& b,
                          const TipFeatures& of_b, const Eigen::VectorXi& vertex_of_a) {
  const auto lay = [&](Similarity& motion, const std::vector<int>& vertices) {
    std::vector<int> mine;
    std::vector<int> theirs;
    for (const int vertex : vertices) {
      if (vertex_of_a[vertex] < 0) continue;
      mine.push_back(vertex);
      theirs.push_back(vertex_of_a[vertex]);
    }
    if (mine.size() < 3) return;
    Eigen::Matrix3Xd from = a.surface.positions(mine, Eigen::all).transpose();
    Eigen::Matrix3Xd to = b.surface.positions(theirs, Eigen::all).transpose();
    motion.from = from.rowwise().mean();
    motion.to = to.rowwise().mean();
    from.colwise() -= motion.from;
    to.colwise() -= motion.to;
    motion.rotation = rotation_between(from, to);
  };
  Similarity start;
  start.scale = of_b.unit / of_a.unit;
  return Follower(a, of_a, start, 0, lay).follow();
}

namespace {

bool share_an_end(const Branch& one, const Branch& other) {
  for (const int node : {one.nodes.front(), one.nodes.back()}) {
    if (node == other.nodes.front() || node == other.nodes.back()) return true;
  }
  return false;
}

/// Pairs that hang together in both: from the middle outwards, each has a neighbour nearer to it
/// whose partner is a neighbour of its own partner.
std::vector<BranchPair> hanging_together(const std::vector<Branch>& of_a,
                                         const std::vector<Branch>& of_b,
                                         const TipFeatures& features,
                                         std::vector<BranchPair> pairs) {
  const auto nearness = [&](const BranchPair& pair) {
    const std::vector<int>& nodes = of_a[idx(pair.a)].nodes;
    return std::min(features.from_centre[idx(nodes.front())],
                    features.from_centre[idx(nodes.back())]);
  };
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& one, const auto& other) {
    return nearness(one) < nearness(other);
  });
  std::vector<BranchPair> kept;
  std::vector<bool> has_one(features.middle.size(), false);
  for (const BranchPair& pair : pairs) {
    const std::size_t component = idx(features.component[idx(of_a[idx(pair.a)].nodes.front())]);
    const bool hangs =
        !has_one[component] || std::any_of(kept.begin(), kept.end(), [&](const BranchPair& other) {
          return share_an_end(of_a[idx(pair.a)], of_a[idx(other.a)]) &&
                 share_an_end(of_b[idx(pair.b)], of_b[idx(other.b)]);
        });
    if (!hangs) continue;
    has_one[component] = true;
    kept.push_back(pair);
  }
  return kept;
}

/// Motions of known nodes go on along the curve, and from there to the other components.
void spread_motions(const MatchSide& a, const TipFeatures& features, std::vector<bool> known,
                    NodeMotions& motions) {
  std::vector<int> open;
  for (int node = 0; node < features.graph.nodes(); ++node) {
    if (known[idx(node)]) open.push_back(node);
  }
  const std::vector<int> anchors = open;
  for (std::size_t k = 0; k < open.size(); ++k) {
    for (const int next : features.graph.neighbours(open[k])) {
      if (known[idx(next)]) continue;
      known[idx(next)] = true;
      motions.of_node[idx(next)] = motions.of_node[idx(open[k])];
      open.push_back(next);
    }
  }
  for (int node = 0; node < features.graph.nodes(); ++node) {
    if (known[idx(node)]) continue;
    int nearest = -1;
    double least = 0;
    for (const int other : anchors) {
      const double distance =
          (a.skeleton.nodes.row(other) - a.skeleton.nodes.row(node)).squaredNorm();
      if (nearest >= 0 && distance >= least) continue;
      nearest = other;
      least = distance;
    }
    if (nearest >= 0) motions.of_node[idx(node)] = motions.of_node[idx(nearest)];
  }
}

}  // namespace

NodeMotions anchored_motions(const MatchSide& a, const TipFeatures& of_a, const MatchSide& b,
                             const std::vector<BranchPair>& pairs, const NodeMotions& motions) {
  NodeMotions anchored = motions;
  std::vector<bool> is_known(motions.of_node.size(), false);
  const std::vector<Branch> all_a = branches(a.skeleton);
  const std::vector<Branch> all_b = branches(b.skeleton);
  for (const BranchPair& pair : hanging_together(all_a, all_b, of_a, pairs)) {
    const std::vector<int>& nodes = all_a[idx(pair.a)].nodes;
    const BranchCurve from = branch_curve(a.skeleton, all_a[idx(pair.a)]);
    const BranchCurve to = branch_curve(b.skeleton, all_b[idx(pair.b)]);
    const BranchLaying laying = laying_of({a, all_a[idx(pair.a)], from},
                                          {b, all_b[idx(pair.b)], to}, pair.reversed, motions);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (is_known[idx(nodes[k])]) continue;
      is_known[idx(nodes[k])] = true;
      const double t = laying.length_on_partner(from, to, from.lengths[k]);
      Similarity& motion = anchored.of_node[idx(nodes[k])];
      const Eigen::Vector3d here = motion.rotation * derivatives_at(from, from.lengths[k]).first;
      const Eigen::Vector3d there = (pair.reversed ? -1 : 1) * derivatives_at(to, t).first;
      motion.rotation = Eigen::Quaterniond::FromTwoVectors(here, there) * motion.rotation;
      motion.from = from.points.row(static_cast<Eigen::Index>(k));
      motion.to = point_at(to, t);
    }
  }
  spread_motions(a, of_a, std::move(is_known), anchored);
  return anchored;
}

}  // namespace curveskel
