#include "skeleton/match/tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

constexpr Eigen::Index radius_samples = 16;

void require_whole(const MatchSide& side, const std::string& name) {
  const CurveSkeleton& skeleton = side.skeleton;
  const auto refuse = [&](const std::string& found, const std::string& needed) {
    throw Error(Fault::input,
                "matching: the skeleton of " + name + " has " + found + ", needed " + needed);
  };
  if (skeleton.edges.rows() == 0) refuse("no edges", "one at least");
  if (skeleton.radii.size() != skeleton.nodes.rows()) refuse("no radii", "one for each node");
  if (skeleton.node_of_vertex.size() != side.surface.positions.rows()) {
    refuse("a map of " + std::to_string(skeleton.node_of_vertex.size()) + " vertices",
           "one of its surface's " + std::to_string(side.surface.positions.rows()));
  }
  require_sound_places(skeleton, "match");
  if (!skeleton.radii.allFinite()) refuse("a radius that is no finite number", "finite ones");
  require_closed_manifold(side.surface, "match");
  if (area(side.surface) > 0) return;
  throw Error(Fault::input, "match: the surface of " + name + " has no area, needed some");
}

class FeatureFinder {
 public:
  explicit FeatureFinder(const MatchSide& side)
      : side_(side), paths_(side.skeleton.nodes.rows()), area_(node_areas()) {
    found_.unit = std::sqrt(area_.sum());
    found_.graph = graph_of(side.skeleton.nodes.rows(), side.skeleton.edges);
    found_.component = component_of_node(side.skeleton);
    for (Eigen::Index e = 0; e < side.skeleton.edges.rows(); ++e) {
      const auto edge = side.skeleton.edges.row(e);
      lengths_.push_back(
          (side.skeleton.nodes.row(edge[0]) - side.skeleton.nodes.row(edge[1])).norm() /
          found_.unit);
    }
    for (int node = 0; node < found_.graph.nodes(); ++node) {
      if (found_.graph.degree(node) == 1) found_.tips.push_back(node);
    }
  }

  TipFeatures find() {
    if (!(found_.unit > 0)) {
      throw Error(
          Fault::input,
          "match: no vertex of a surface has a node of its skeleton, needed some that have");
    }
    find_centres();
    measure_tips();
    find_core();
    find_roots();
    return std::move(found_);
  }

 private:
  /// A third of each face for each of its vertices' nodes.
  Eigen::VectorXd node_areas() const {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(side_.skeleton.nodes.rows());
    for (Eigen::Index face = 0; face < side_.surface.triangles.rows(); ++face) {
      const double third = twice_area(side_.surface, face) / 6;
      for (const int vertex : side_.surface.triangles.row(face)) {
        const int node = side_.skeleton.node_of_vertex[vertex];
        if (node >= 0) areas[node] += third;
      }
    }
    return areas;
  }

  void search(int source) {
    paths_.search(found_.graph, source, ShortestPaths::no_target,
                  [this](int, int, int edge) { return lengths_[idx(edge)]; });
  }

  /// Of each component the node with the least mean distance to its area, of some that are spread
  /// over it.
  void find_centres() {
    constexpr int most_candidates = 200;
    const int nodes = found_.graph.nodes();
    const int components = *std::max_element(found_.component.begin(), found_.component.end()) + 1;
    std::vector<double> best(idx(components), std::numeric_limits<double>::infinity());
    std::vector<int> centre(idx(components), -1);
    std::vector<int> seen(idx(components), 0);
    const int step = std::max(1, nodes / most_candidates);
    for (int node = 0; node < nodes; ++node) {
      const std::size_t component = idx(found_.component[idx(node)]);
      if (seen[component]++ % step != 0) continue;
      search(node);
      double sum = 0;
      for (int other = 0; other < nodes; ++other) {
        if (found_.component[idx(other)] == static_cast<int>(component)) {
          sum += area_[other] * paths_.distance(other);
        }
      }
      if (sum >= best[component]) continue;
      best[component] = sum;
      centre[component] = node;
    }
    found_.from_centre.assign(idx(nodes), 0);
    before_.assign(idx(nodes), -1);
    std::vector<double> areas(idx(components), 0);
    found_.middle = centre;
    for (int component = 0; component < components; ++component) {
      search(centre[idx(component)]);
      for (int node = 0; node < nodes; ++node) {
        if (found_.component[idx(node)] != component) continue;
        found_.from_centre[idx(node)] = paths_.distance(node);
        before_[idx(node)] = paths_.before(node);
        areas[idx(component)] += area_[node];
      }
    }
    found_.area_share = areas;
    for (double& share : found_.area_share) share /= area_.sum();
    find_centroids();
    found_.centre_component =
        static_cast<int>(std::max_element(areas.begin(), areas.end()) - areas.begin());
    found_.centre = side_.skeleton.nodes.row(centre[idx(found_.centre_component)]);
  }

  void find_centroids() {
    found_.centroid.assign(found_.middle.size(), Eigen::Vector3d::Zero());
    std::vector<double> weights(found_.middle.size(), 0);
    for (int node = 0; node < found_.graph.nodes(); ++node) {
      const std::size_t component = idx(found_.component[idx(node)]);
      found_.centroid[component] += area_[node] * side_.skeleton.nodes.row(node).transpose();
      weights[component] += area_[node];
    }
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k] > 0) {
        found_.centroid[k] /= weights[k];
      } else {
        found_.centroid[k] = side_.skeleton.nodes.row(found_.middle[k]);
      }
    }
  }

  void measure_tips() {
    const auto count = static_cast<Eigen::Index>(found_.tips.size());
    found_.apart.setConstant(count, count, unconnected);
    found_.radii.resize(count, radius_samples);
    found_.reach.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const int tip = found_.tips[idx(i)];
      search(tip);
      for (Eigen::Index k = 0; k < count; ++k) {
        const double distance = paths_.distance(found_.tips[idx(k)]);
        if (distance < unconnected) found_.apart(i, k) = distance;
      }
      found_.reach[i] = found_.from_centre[idx(tip)];
      sample_radii(tip, i);
    }
  }

  void sample_radii(int tip, Eigen::Index row) {
    int node = tip;
    const double reach = found_.from_centre[idx(tip)];
    for (Eigen::Index k = 0; k < radius_samples; ++k) {
      const double target = reach * (1 - static_cast<double>(k) / (radius_samples - 1));
      int next = before_[idx(node)];
      while (next >= 0 && found_.from_centre[idx(next)] > target) {
        node = next;
        next = before_[idx(node)];
      }
      const double far = found_.from_centre[idx(node)];
      const double near = next < 0 ? far : found_.from_centre[idx(next)];
      const double share = far > near ? std::clamp((far - target) / (far - near), 0.0, 1.0) : 0;
      const double other = next < 0 ? side_.skeleton.radii[node] : side_.skeleton.radii[next];
      found_.radii(row, k) =
          ((1 - share) * side_.skeleton.radii[node] + share * other) / found_.unit;
    }
  }

  void find_core() {
    std::vector<int> order;
    for (int node = 0; node < found_.graph.nodes(); ++node) {
      if (found_.component[idx(node)] == found_.centre_component) order.push_back(node);
    }
    std::sort(order.begin(), order.end(), [this](int a, int b) {
      return found_.from_centre[idx(a)] < found_.from_centre[idx(b)];
    });
    double sum = 0;
    for (const int node : order) {
      found_.core_radius = found_.from_centre[idx(node)];
      sum += area_[node];
      if (sum >= core_share * area_.sum()) break;
    }
    for (Eigen::Index v = 0; v < side_.skeleton.node_of_vertex.size(); ++v) {
      const int node = side_.skeleton.node_of_vertex[v];
      if (node < 0 || found_.component[idx(node)] != found_.centre_component) continue;
      if (found_.from_centre[idx(node)] <= found_.core_radius) {
        found_.core_vertices.push_back(static_cast<int>(v));
      }
    }
  }

  void find_roots() {
    found_.roots.resize(3, static_cast<Eigen::Index>(found_.tips.size()));
    for (std::size_t i = 0; i < found_.tips.size(); ++i) {
      int node = found_.tips[i];
      while (before_[idx(node)] >= 0 && found_.from_centre[idx(node)] > found_.core_radius) {
        node = before_[idx(node)];
      }
      found_.roots.col(static_cast<Eigen::Index>(i)) = side_.skeleton.nodes.row(node);
    }
  }

  const MatchSide& side_;
  ShortestPaths paths_;
  Eigen::VectorXd area_;
  std::vector<double> lengths_;  ///< per edge
  std::vector<int> before_;      ///< per node: the next on the way to the middle
  TipFeatures found_;
};

}  // namespace

TipFeatures tip_features(const MatchSide& side, const std::string& name) {
  require_whole(side, name);
  return FeatureFinder(side).find();
}

Eigen::MatrixXd likeness(const TipFeatures& a, const TipFeatures& b) {
  // Of the same limb in another pose, reach changes by a few percent, radii by more.
  constexpr double reach_scale = 0.15;
  constexpr double radius_scale = 0.5;
  constexpr double thin = 1e-3;
  Eigen::MatrixXd like(a.reach.size(), b.reach.size());
  const Eigen::MatrixXd log_a = (a.radii.array().max(0) + thin).log();
  const Eigen::MatrixXd log_b = (b.radii.array().max(0) + thin).log();
  for (Eigen::Index i = 0; i < like.rows(); ++i) {
    for (Eigen::Index j = 0; j < like.cols(); ++j) {
      const double reach = std::log((a.reach[i] + 0.05) / (b.reach[j] + 0.05)) / reach_scale;
      const double radius = (log_a.row(i) - log_b.row(j)).squaredNorm() / radius_samples /
                            (radius_scale * radius_scale);
      like(i, j) = std::exp(-0.5 * (reach * reach + radius));
    }
  }
  return like;
}

}  // namespace curveskel
