#include "skeleton/embed/ends/rims.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {
namespace {

constexpr double nearness = 2.5;  // of a ball or a rim, whichever is larger

struct Rim {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double mean_radius = 0;
  double least_radius = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of length 1, or zero: it has no plane
};

/// Of the rim's vector area; zero where the rim is so folded that it encloses little.
Eigen::Vector3d normal_of(const Positions& positions, const std::vector<std::int32_t>& vertices,
                          const Rim& rim) {
  constexpr double least_share = 0.3;  // of a circle's area
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d a = positions.row(vertices[i]);
    const Eigen::Vector3d b = positions.row(vertices[(i + 1) % vertices.size()]);
    area += (a - rim.middle).cross(b - rim.middle) / 2;
  }
  const double circle = std::numbers::pi * rim.mean_radius * rim.mean_radius;
  if (!(area.norm() > least_share * circle)) return Eigen::Vector3d::Zero();
  return area.normalized();
}

/// The middle of the rim's length, however its vertices are spaced.
Rim rim_of(const Positions& positions, const std::vector<std::int32_t>& vertices) {
  Rim rim;
  double length = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d a = positions.row(vertices[i]);
    const Eigen::Vector3d b = positions.row(vertices[(i + 1) % vertices.size()]);
    rim.middle += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  if (length > 0) rim.middle /= length;
  for (const std::int32_t v : vertices) {
    const double radius = (positions.row(v).transpose() - rim.middle).norm();
    rim.mean_radius += radius / double(vertices.size());
    rim.least_radius = std::min(rim.least_radius, radius);
  }
  rim.normal = normal_of(positions, vertices, rim);
  return rim;
}

bool way_is_inside(const SurfaceTree& tree, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to) {
  return tree.inscribed_radius(to) > 0 && !crosses(tree, from, to);
}

void add_node(CurveSkeleton& skeleton, int neighbour, const Eigen::Vector3d& position,
              double radius, double life) {
  const Eigen::Index node = skeleton.nodes.rows();
  skeleton.nodes.conservativeResize(node + 1, 3);
  skeleton.nodes.row(node) = position;
  skeleton.radii.conservativeResize(node + 1);
  skeleton.radii[node] = radius;
  if (skeleton.lives.size() > 0) {
    skeleton.lives.conservativeResize(node + 1);
    skeleton.lives[node] = life;
  }
  const Eigen::Index edges = skeleton.edges.rows();
  // The new node has the highest number: among the edges of its neighbour its own comes last.
  Eigen::Index place = 0;
  while (place < edges && skeleton.edges(place, 0) <= neighbour) ++place;
  skeleton.edges.conservativeResize(edges + 1, 2);
  for (Eigen::Index e = edges; e > place; --e) skeleton.edges.row(e) = skeleton.edges.row(e - 1);
  skeleton.edges.row(place) << neighbour, static_cast<int>(node);
}

/// Leads a tip on, which hands its life to the new one.
void lengthen(CurveSkeleton& skeleton, int tip, const Eigen::Vector3d& position, double radius) {
  const bool has_life = skeleton.lives.size() > 0;
  add_node(skeleton, tip, position, radius, has_life ? skeleton.lives[tip] : 0);
  if (has_life) skeleton.lives[tip] = 0;
}

/// A tip's branch from the tip inwards.
using Limb = std::vector<int>;

/// A node on its own is a limb, too.
std::vector<Limb> limbs_of(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<Limb> limbs;
  for (Branch& branch : branches(skeleton)) {
    const bool from_back = degree[idx(branch.nodes.back())] == 1;
    if (degree[idx(branch.nodes.front())] == 1) limbs.push_back(branch.nodes);
    if (!from_back) continue;
    std::reverse(branch.nodes.begin(), branch.nodes.end());
    limbs.push_back(std::move(branch.nodes));
  }
  for (int node = 0; node < static_cast<int>(degree.size()); ++node) {
    if (degree[idx(node)] == 0) limbs.push_back({node});
  }
  return limbs;
}

/// Leads the curve to the middles of rims.
class Reaching {
 public:
  Reaching(CurveSkeleton& skeleton, const Surface& surface, double diagonal,
           const SurfaceTree& tree, const SurfaceTree* open,
           const std::vector<std::vector<std::int32_t>>& rims)
      : skeleton_(skeleton),
        tree_(tree),
        open_(open),
        below_(depth * diagonal),
        limbs_(limbs_of(skeleton)),
        taken_(limbs_.size(), false),
        reached_(rims.size(), false) {
    for (const auto& vertices : rims) rims_.push_back(rim_of(surface.positions, vertices));
  }

  void run() {
    reach_from_within_balls();
    reach_from_limbs();
    reach_from_the_side();
  }

 private:
  static constexpr double depth = 1e-3;  // of D

  /// The end of a curve that comes from `from`.
  Eigen::Vector3d end_of(const Rim& rim, const Eigen::Vector3d& from) const {
    return rim.middle - below_ * (rim.middle - from).normalized();
  }

  [[nodiscard]] bool is_near(int node, const Rim& rim, double least_width) const {
    const double radius = skeleton_.radii[node];
    const Eigen::Vector3d p = skeleton_.nodes.row(node);
    const double distance = (rim.middle - p).norm();
    return distance <= nearness * std::max(radius, rim.mean_radius) &&
           rim.mean_radius >= least_width * radius && way_is_inside(tree_, p, end_of(rim, p));
  }

  /// The limb's radius at a node, which holes beside it do not make narrower.
  [[nodiscard]] double width_at(int node) const {
    const double radius = skeleton_.radii[node];
    if (open_ == nullptr) return radius;
    return std::max(radius, open_->nearest(skeleton_.nodes.row(node)).distance);
  }

  /// The direction in which the limb arrives at its node k from outside the ball there; within, it
  /// has none, zero.
  [[nodiscard]] Eigen::Vector3d direction(const Limb& limb, std::size_t k) const {
    const Eigen::Vector3d p = skeleton_.nodes.row(limb[k]);
    for (std::size_t i = k + 1; i < limb.size(); ++i) {
      const Eigen::Vector3d way = p - skeleton_.nodes.row(limb[i]).transpose();
      if (way.norm() >= skeleton_.radii[limb[k]] || i + 1 == limb.size()) return way.normalized();
    }
    return Eigen::Vector3d::Zero();
  }

  [[nodiscard]] bool faces(const Limb& limb, std::size_t k, const Rim& rim) const {
    constexpr double cosine = 0.5;
    const Eigen::Vector3d arrives = direction(limb, k);
    if (arrives.isZero()) return true;
    const Eigen::Vector3d p = skeleton_.nodes.row(limb[k]);
    // A hole in the limb's side, which is narrower than the limb, is none that the limb ends in.
    const bool lies_along = !rim.normal.isZero() && std::abs(arrives.dot(rim.normal)) < cosine;
    if (lies_along && rim.mean_radius < width_at(limb[k])) return false;
    return arrives.dot((rim.middle - p).normalized()) >= cosine;
  }

  /// The nodes lie evenly between two places from now on.
  void place_between(const Limb& limb, std::size_t count, const Eigen::Vector3d& from,
                     const Eigen::Vector3d& to) {
    for (std::size_t i = 0; i < count; ++i) {
      const double t = double(i + 1) / double(count + 1);
      skeleton_.nodes.row(limb[i]) = (from + t * (to - from)).transpose();
      skeleton_.radii[limb[i]] =
          std::max(0.0, tree_.inscribed_radius(skeleton_.nodes.row(limb[i])));
    }
  }

  /// A curve within one ball has no direction: between two rims it becomes straight.
  void reach_from_within_balls() {
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
      const Limb& limb = limbs_[l];
      if (taken_[l] || !is_within_its_ball(limb)) continue;
      std::vector<std::size_t> near;
      for (std::size_t o = 0; o < rims_.size(); ++o) {
        if (!reached_[o] && is_near(widest(limb), rims_[o], usual_width)) near.push_back(o);
      }
      if (near.size() != 2) continue;
      straighten(l, near[0], near[1]);
    }
  }

  void straighten(std::size_t l, std::size_t first, std::size_t second) {
    constexpr double least_room = 0.7;  // half-way, of the widest place that is replaced
    const Limb limb = limbs_[l];
    const Eigen::Vector3d a = end_of(rims_[first], rims_[second].middle);
    const Eigen::Vector3d b = end_of(rims_[second], rims_[first].middle);
    if (tree_.inscribed_radius((a + b) / 2) < least_room * skeleton_.radii[widest(limb)]) return;
    place_between(limb, limb.size(), a, b);
    lengthen(skeleton_, limb.front(), a, rims_[first].least_radius);
    lengthen(skeleton_, limb.back(), b, rims_[second].least_radius);
    reached_[first] = reached_[second] = true;
    for (std::size_t other = 0; other < limbs_.size(); ++other) {
      if (limbs_[other].front() == limb.back()) taken_[other] = true;
    }
    taken_[l] = true;
  }

  [[nodiscard]] int widest(const Limb& limb) const {
    return *std::max_element(limb.begin(), limb.end(),
                             [&](int a, int b) { return skeleton_.radii[a] < skeleton_.radii[b]; });
  }

  /// The whole component, that is: its limb ends in another tip. Short limbs end within 1.5 radii.
  [[nodiscard]] bool is_within_its_ball(const Limb& limb) const {
    const bool whole = std::any_of(limbs_.begin(), limbs_.end(), [&](const Limb& other) {
      return other.front() == limb.back() && other.size() == limb.size();
    });
    const int middle = widest(limb);
    return whole && std::all_of(limb.begin(), limb.end(), [&](int node) {
             return (skeleton_.nodes.row(node) - skeleton_.nodes.row(middle)).norm() <=
                    1.5 * skeleton_.radii[middle];
           });
  }

  /// True if no node from the tip to node k reaches much farther ahead than the rim: only what
  /// turns aside there may move to the way to it.
  [[nodiscard]] bool keeps_reach(const Limb& limb, std::size_t k, const Rim& rim) const {
    constexpr double most_lost = 1.25;  // of the ball at node k or the rim
    const double farthest = most_lost * std::max(skeleton_.radii[limb[k]], rim.least_radius);
    const Eigen::Vector3d ahead = direction(limb, k);
    return std::all_of(limb.begin(), limb.begin() + static_cast<std::ptrdiff_t>(k), [&](int node) {
      return (skeleton_.nodes.row(node).transpose() - rim.middle).dot(ahead) <= farthest;
    });
  }

  /// The nodes from the tip on that would have to move for the limb to go on to the rim without
  /// turning back; -1 = it cannot. A hole may be long but narrow, a slit along the limb: its width
  /// bounds the way back from the tip, not its length.
  [[nodiscard]] int nodes_to_move(const Limb& limb, const Rim& rim) const {
    double walked = 0;
    for (std::size_t k = 0; k < limb.size(); ++k) {
      if (k > 0) walked += (skeleton_.nodes.row(limb[k]) - skeleton_.nodes.row(limb[k - 1])).norm();
      if (k > 0 && k + 1 == limb.size()) break;
      if (walked > nearness * std::max(skeleton_.radii[limb[k]], rim.least_radius)) break;
      if (!faces(limb, k, rim) || !is_near(limb[k], rim, usual_width)) continue;
      if (keeps_reach(limb, k, rim)) return static_cast<int>(k);
    }
    return -1;
  }

  /// Each tip serves one rim: those go first that need to move least, then the nearest.
  void reach_from_limbs() {
    std::vector<std::tuple<int, double, std::size_t, std::size_t>> pairs;
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
      for (std::size_t o = 0; o < rims_.size(); ++o) {
        if (taken_[l] || reached_[o]) continue;
        const int moved = nodes_to_move(limbs_[l], rims_[o]);
        if (moved < 0) continue;
        const Eigen::Vector3d p = skeleton_.nodes.row(limbs_[l][idx(moved)]);
        pairs.emplace_back(moved, (rims_[o].middle - p).norm(), l, o);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [moved, distance, l, o] : pairs) {
      if (taken_[l] || reached_[o]) continue;
      taken_[l] = reached_[o] = true;
      if (distance <= 2 * below_) continue;
      const Limb& limb = limbs_[l];
      const Eigen::Vector3d from = skeleton_.nodes.row(limb[idx(moved)]);
      const Eigen::Vector3d end = end_of(rims_[o], from);
      place_between(limb, idx(moved), end, from);
      lengthen(skeleton_, limb.front(), end, rims_[o].least_radius);
    }
  }

  /// A hole in the side of a limb touches the ball there and is narrower than the limb: nothing
  /// leads away to it. A waist is as wide as the body at the crotch.
  [[nodiscard]] bool is_beside_the_curve(const Rim& rim) const {
    for (Eigen::Index node = 0; node < skeleton_.nodes.rows(); ++node) {
      const double distance = (rim.middle - skeleton_.nodes.row(node).transpose()).norm();
      const bool touches = distance < least_length * skeleton_.radii[node];
      if (touches && rim.mean_radius < width_at(static_cast<int>(node))) return true;
    }
    return false;
  }

  /// A wide rim that no tip leads to, the waist of trousers, gets a branch from the nearest
  /// place that makes it no spur.
  void reach_from_the_side() {
    constexpr double least_width_of_side = 0.7;
    constexpr double least_width_of_slit = 0.5;  // at its narrowest; rims are jagged
    constexpr double junction_cost = 0.7;        // a rim near a junction hangs from it
    const std::vector<int> degree = degrees(skeleton_.nodes.rows(), skeleton_.edges);
    for (std::size_t o = 0; o < rims_.size(); ++o) {
      if (reached_[o] || is_beside_the_curve(rims_[o])) continue;
      int best = -1;
      double nearest = std::numeric_limits<double>::infinity();
      for (int node = 0; node < static_cast<int>(degree.size()); ++node) {
        const double distance = (rims_[o].middle - skeleton_.nodes.row(node).transpose()).norm();
        const double cost = distance * (degree[idx(node)] > 2 ? junction_cost : 1);
        if (distance < least_length * skeleton_.radii[node] || cost >= nearest) continue;
        if (rims_[o].least_radius < least_width_of_slit * skeleton_.radii[node]) continue;
        if (!is_near(node, rims_[o], least_width_of_side)) continue;
        best = node;
        nearest = cost;
      }
      if (best < 0) continue;
      const Eigen::Vector3d end = end_of(rims_[o], skeleton_.nodes.row(best));
      const double length = (end - skeleton_.nodes.row(best).transpose()).norm();
      add_node(skeleton_, best, end, rims_[o].least_radius, length / skeleton_.radii[best]);
    }
  }

  static constexpr double usual_width = 0.5;   // of a rim, in radii of the ball before it
  static constexpr double least_length = 1.1;  // of a branch from the side, in radii

  CurveSkeleton& skeleton_;
  const SurfaceTree& tree_;
  const SurfaceTree* open_;  // over the surface without what closes its holes; may be null
  double below_;             // the closing of a hole
  std::vector<Rim> rims_;
  std::vector<Limb> limbs_;
  std::vector<char> taken_;    // by limb
  std::vector<char> reached_;  // by rim
};

}  // namespace

void reach_rims(CurveSkeleton& skeleton, const Surface& surface, double diagonal,
                const SurfaceTree& tree, const Surface& open,
                const std::vector<std::vector<std::int32_t>>& rims) {
  if (rims.empty()) return;
  std::optional<SurfaceTree> open_tree;
  if (open.triangles.rows() > 0) open_tree.emplace(open);
  Reaching(skeleton, surface, diagonal, tree, open_tree ? &*open_tree : nullptr, rims).run();
  if (!open_tree) return;
  constexpr double rounding = 1e-9;  // of two trees over the same faces
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    const Eigen::Vector3d place = skeleton.nodes.row(node);
    const double closed = tree.inscribed_radius(place);
    const double distance = open_tree->nearest(place).distance;
    if (closed > 0 && distance > (1 + rounding) * closed) skeleton.radii[node] = distance;
  }
}

}  // namespace curveskel
