#include "skeleton/graph/draft.hpp"

#include <algorithm>
#include <numeric>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

void require_index(int found, Eigen::Index count, const std::string& edit, const char* what) {
  if (found >= 0 && found < count) return;
  const std::string needed = count > 0 ? "needed one of 0 to " + std::to_string(count - 1)
                                       : std::string("but the skeleton has none");
  throw Error(Fault::input, edit + ": found the " + what + " " + std::to_string(found) + ", " +
                                needed + "; choose another");
}

std::pair<int, int> ascending_pair(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

void require_node(const CurveSkeleton& skeleton, int node, const std::string& edit) {
  require_sound(skeleton, edit);
  require_index(node, skeleton.nodes.rows(), edit, "node");
}

void require_edge(const CurveSkeleton& skeleton, int edge, const std::string& edit) {
  require_sound(skeleton, edit);
  require_index(edge, skeleton.edges.rows(), edit, "edge");
}

Draft::Draft(const CurveSkeleton& skeleton)
    : skeleton_(skeleton), heir_(idx(skeleton.nodes.rows())) {
  std::iota(heir_.begin(), heir_.end(), 0);
  for (const auto& edge : skeleton.edges.rowwise()) {
    edges_.emplace_hint(edges_.end(), edge[0], edge[1]);
  }
}

void Draft::connect(int a, int b) {
  if (a != b) edges_.insert(ascending_pair(a, b));
}

void Draft::disconnect(int a, int b) { edges_.erase(ascending_pair(a, b)); }

bool Draft::connected(int a, int b) const { return edges_.contains(ascending_pair(a, b)); }

std::vector<int> Draft::neighbours(int node) const {
  std::vector<int> found;
  for (const auto& [i, j] : edges_) {
    if (i == node) found.push_back(j);
    if (j == node) found.push_back(i);
  }
  return found;
}

Eigen::Vector3d Draft::position(int node) const { return skeleton_.nodes.row(node); }

double Draft::radius(int node) const {
  return skeleton_.radii.size() > 0 ? skeleton_.radii[node] : 0;
}

void Draft::place(int node, const Eigen::Vector3d& point, double without_tree,
                  const SurfaceTree* tree) {
  skeleton_.nodes.row(node) = point;
  if (skeleton_.radii.size() == 0) return;
  skeleton_.radii[node] =
      tree != nullptr ? std::max(0.0, tree->inscribed_radius(point)) : without_tree;
}

int Draft::add(const Eigen::Vector3d& point, double without_tree, const SurfaceTree* tree) {
  const auto node = static_cast<int>(skeleton_.nodes.rows());
  const bool with_lives = has_lives(skeleton_);
  skeleton_.nodes.conservativeResize(node + 1, 3);
  if (skeleton_.radii.size() > 0) skeleton_.radii.conservativeResize(node + 1);
  if (with_lives) {
    skeleton_.lives.conservativeResize(node + 1);
    skeleton_.lives[node] = 0;
  }
  heir_.push_back(node);
  place(node, point, without_tree, tree);
  return node;
}

void Draft::dissolve(int node, int heir) {
  for (const int neighbour : neighbours(node)) {
    disconnect(node, neighbour);
    connect(heir, neighbour);
  }
  for (int& whose : heir_) {
    if (whose == node) whose = heir;
  }
  if (!has_lives(skeleton_)) return;
  skeleton_.lives[heir] = std::max(skeleton_.lives[heir], skeleton_.lives[node]);
}

void Draft::give_lives(CurveSkeleton& result, const std::vector<int>& kept) const {
  const auto degrees_in = [](const CurveSkeleton& skeleton) {
    std::vector<int> degrees(idx(skeleton.nodes.rows()), 0);
    for (const int end : skeleton.edges.reshaped()) ++degrees[idx(end)];
    return degrees;
  };
  const std::vector<int> before = degrees_in(skeleton_);
  const std::vector<int> now = degrees_in(result);
  result.lives = skeleton_.lives(kept);
  const double largest = std::max(skeleton_.lives.maxCoeff(), least_life(0));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    double& life = result.lives[static_cast<Eigen::Index>(k)];
    if (now[k] > 1) life = 0;
    if (now[k] == 1 && before[idx(kept[k])] != 1 && life == 0) life = largest;
  }
}

CurveSkeleton Draft::finish() const {
  std::vector<int> number(heir_.size(), -1);  // of those that stay
  std::vector<int> kept;
  for (std::size_t node = 0; node < heir_.size(); ++node) {
    if (heir_[node] != static_cast<int>(node)) continue;
    number[node] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(node));
  }
  CurveSkeleton result;
  result.nodes = skeleton_.nodes(kept, Eigen::all);
  if (skeleton_.radii.size() > 0) result.radii = skeleton_.radii(kept);
  result.edges.resize(static_cast<Eigen::Index>(edges_.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [i, j] : edges_) result.edges.row(row++) << number[idx(i)], number[idx(j)];
  if (has_lives(skeleton_)) give_lives(result, kept);
  result.node_of_vertex = skeleton_.node_of_vertex;
  for (int& node : result.node_of_vertex) {
    if (node >= 0) node = number[idx(heir_[idx(node)])];
  }
  return result;
}

}  // namespace curveskel
