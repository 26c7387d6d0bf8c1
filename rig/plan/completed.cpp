#include "rig/plan/completed.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// Hangs the mirror image of a part from a node, as the part hangs from `from`. Precondition: `at`
/// is not in the part.
void add_image(Completed& body, const std::vector<int>& part, int from, int at) {
  CurveTree& tree = body.tree;
  const auto image = [&](const Vector3d& p) -> Vector3d {
    return {2 * tree.middle - p.x(), p.y(), p.z()};
  };
  const Vector3d shift = tree.nodes[idx(at)] - image(tree.nodes[idx(from)]);
  std::vector<int> image_of(tree.nodes.size(), -1);
  image_of[idx(from)] = at;
  for (const int node : part) {
    image_of[idx(node)] = static_cast<int>(tree.nodes.size());
    tree.nodes.emplace_back(image(tree.nodes[idx(node)]) + shift);
    tree.radii.push_back(double(tree.radii[idx(node)]));
    tree.neighbours.emplace_back();
  }
  for (const int node : part) {
    const std::vector<int> neighbours = tree.neighbours[idx(node)];
    for (const int next : neighbours) {
      if (image_of[idx(next)] < 0) continue;
      tree.neighbours[idx(image_of[idx(node)])].push_back(image_of[idx(next)]);
      if (next == from) tree.neighbours[idx(at)].push_back(image_of[idx(node)]);
    }
    if (neighbours.size() > 1) continue;
    const bool is_left = tree.aside(node) > 0;
    body.pairs.mate[is_left ? node : image_of[idx(node)]] = is_left ? image_of[idx(node)] : node;
  }
  const std::size_t vertices = tree.vertices.size();
  for (std::size_t v = 0; v < vertices; ++v) {
    const int node = tree.node_of_vertex[v];
    if (node < 0 || node == from || image_of[idx(node)] < 0) continue;
    tree.vertices.emplace_back(image(tree.vertices[v]) + shift);
    tree.node_of_vertex.push_back(image_of[idx(node)]);
  }
}

/// All that hangs from a node beyond it, as seen from where a path to it begins.
std::vector<int> beyond(const CurveTree& tree, const std::vector<int>& path) {
  std::vector<char> seen(tree.nodes.size(), 0);
  for (const int node : path) seen[idx(node)] = 1;
  std::vector<int> all;
  for (const int next : tree.neighbours[idx(path.back())]) {
    if (seen[idx(next)] != 0) continue;
    const std::vector<int> part = part_of(tree, next, seen);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace

std::optional<Completed> with_missing_limb(const CurveTree& tree, const TipPairs& pairs,
                                           const Limbs& limbs) {
  std::vector<char> has_image(tree.nodes.size(), 0);
  for (const auto& [left, right] : pairs.mate) has_image[idx(left)] = has_image[idx(right)] = 1;
  std::vector<int> best;
  int root = -1;
  double longest = 0;
  std::vector<char> seen = limbs.is_trunk;
  for (const int at : limbs.trunk) {
    for (const int first : tree.neighbours[idx(at)]) {
      if (seen[idx(first)] != 0) continue;
      std::vector<int> part = part_of(tree, first, seen);
      if (std::any_of(part.begin(), part.end(), [&](int k) { return has_image[idx(k)] != 0; })) {
        continue;
      }
      const Ways ways = ways_from(tree, at);
      double length = 0;
      for (const int node : part) length = std::max(length, ways.distance[idx(node)]);
      if (length <= longest) continue;
      longest = length;
      best = std::move(part);
      root = at;
    }
  }
  if (root < 0) return std::nullopt;
  Completed body{tree, pairs};
  add_image(body, best, root, root);
  return body;
}

std::optional<Completed> with_whole_limb(const CurveTree& tree, const TipPairs& pairs,
                                         const LimbWay& limb) {
  const int left = limb.path.back();
  const int right = limb.mirror.back();
  const bool ends_left = tree.is_tip(left);
  if (ends_left == tree.is_tip(right)) return std::nullopt;
  const std::vector<int>& whole = ends_left ? limb.mirror : limb.path;
  const int stump = ends_left ? left : right;
  const std::vector<int> part = beyond(tree, whole);
  // Both ways are of one limb then.
  if (std::find(part.begin(), part.end(), stump) != part.end()) return std::nullopt;
  Completed body{tree, pairs};
  body.pairs.mate.erase(left);
  add_image(body, part, whole.back(), stump);
  return body;
}

}  // namespace curveskel
