#include "rig/plan/unposed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// By node.
using Moves = std::vector<Vector3d>;

/// The nodes of a way, and what hangs from each of them, with the way's root and by their shares of
/// its length.
void move_limb(const CurveTree& tree, const Limbs& limbs, const std::vector<int>& way,
               const std::vector<Vector3d>& by_share, Moves& moves) {
  std::vector<char> seen = limbs.is_trunk;
  for (const int node : way) seen[idx(node)] = 1;
  const Ways from_root = ways_from(tree, way.front());
  const double whole = std::max(from_root.distance[idx(way.back())], 1e-300);
  for (const int node : way) {
    if (limbs.is_trunk[idx(node)] != 0) continue;
    const double share = from_root.distance[idx(node)] / whole;
    const auto at =
        static_cast<std::size_t>(std::lround(share * static_cast<double>(by_share.size() - 1)));
    const Vector3d move = moves[idx(way.front())] + by_share[at];
    for (const int other : part_of(tree, node, seen)) moves[idx(other)] = move;
  }
}

/// To the mean of both courses, each as seen from where it begins.
void move_pair(const CurveTree& tree, const Limbs& limbs, const LimbWay& way, Moves& moves) {
  const Course left = side_course(tree, way, true);
  const Course right = side_course(tree, way, false);
  std::vector<Vector3d> of_left;
  std::vector<Vector3d> of_right;
  for (std::size_t k = 0; k < left.points.size(); ++k) {
    const Vector3d apart = (right.points[k] - right.points[0]) - (left.points[k] - left.points[0]);
    of_left.emplace_back(0.5 * apart);
    of_right.emplace_back(0.5 * apart.x(), -0.5 * apart.y(), -0.5 * apart.z());
  }
  move_limb(tree, limbs, way.path, of_left, moves);
  move_limb(tree, limbs, way.mirror, of_right, moves);
}

/// Of the surface about a limb and all that hangs from it.
double lowest_about(const CurveTree& tree, const Limbs& limbs, const std::vector<int>& way) {
  double lowest = std::numeric_limits<double>::infinity();
  const std::vector<char> is_own = nodes_of_side(tree, limbs, way);
  for (std::size_t k = 0; k < is_own.size(); ++k) {
    if (is_own[k] != 0) lowest = std::min(lowest, tree.nodes[k].y());
  }
  for (std::size_t v = 0; v < tree.vertices.size(); ++v) {
    const int node = tree.node_of_vertex[v];
    if (node >= 0 && is_own[idx(node)] != 0) lowest = std::min(lowest, tree.vertices[v].y());
  }
  return lowest;
}

void measure_box(CurveTree& tree) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  for (const Vector3d& vertex : tree.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  tree.ground = low.y();
  tree.height = high.y() - low.y();
  tree.size = (high - low).maxCoeff();
}

}  // namespace

Unposed unpose(const CurveTree& tree, const Limbs& limbs) {
  Unposed result{tree, limbs};
  if (limbs.pairs.empty()) return result;
  double middle = 0;
  for (const LimbPair& pair : limbs.pairs) {
    middle += tree.nodes[idx(pair.root)].x() / static_cast<double>(limbs.pairs.size());
  }
  Moves moves(tree.nodes.size(), Vector3d::Zero());
  for (const int node : limbs.trunk) moves[idx(node)].x() = middle - tree.nodes[idx(node)].x();
  for (const LimbPair& pair : limbs.pairs) move_pair(tree, limbs, pair.ways.front(), moves);
  result.tree.middle = middle;
  for (std::size_t k = 0; k < moves.size(); ++k) result.tree.nodes[k] += moves[k];
  for (std::size_t v = 0; v < tree.vertices.size(); ++v) {
    const int node = tree.node_of_vertex[v];
    if (node >= 0) result.tree.vertices[v] += moves[idx(node)];
  }
  measure_box(result.tree);
  for (LimbPair& pair : result.limbs.pairs) {
    const LimbWay& way = pair.ways.front();
    pair.length = 0.5 * (way.length + ways_from(tree, pair.root).distance[idx(way.mirror.back())]);
    pair.lowest = std::min(pair.lowest, lowest_about(tree, limbs, way.mirror)) - tree.ground +
                  result.tree.ground;
  }
  return result;
}

void move_spread(const CurveTree& posed, CurveTree& unposed) {
  for (Vector3d& point : unposed.spread) {
    const std::size_t nearest =
        idx(nearest_ball(posed, static_cast<int>(posed.nodes.size()), point));
    point += unposed.nodes[nearest] - posed.nodes[nearest];
  }
}

}  // namespace curveskel
