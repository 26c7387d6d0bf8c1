#include "rig/plan/curve_tree.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include <curveskel/advanced/indices.hpp>
#include "surface/spatial/spread_points.hpp"

namespace curveskel {

using Eigen::Vector3d;

bool CurveTree::is_tip(int node) const { return neighbours[idx(node)].size() == 1; }
double CurveTree::aside(int node) const { return nodes[idx(node)].x() - middle; }

std::vector<int> tips_of(const CurveTree& tree) {
  std::vector<int> tips;
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    if (tree.is_tip(node)) tips.push_back(node);
  }
  return tips;
}

int nearest_ball(const CurveTree& tree, int nodes, const Vector3d& point) {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int node = 0; node < nodes; ++node) {
    const double off = (tree.nodes[idx(node)] - point).norm() - tree.radii[idx(node)];
    if (off >= least) continue;
    least = off;
    nearest = node;
  }
  return nearest;
}

const RootedTree& LookedAt::rooted(const Vector3d& up) {
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const auto& known) { return known.first == up; });
  if (found != known_.end()) return found->second;
  return known_.emplace_back(up, trees_.with_up(up)).second;
}

CurveTree LookedAt::tree(const Eigen::Matrix3d& axes) {
  constexpr int spread = 20000;
  if (spread_.empty()) spread_ = spread_points(surface_, spread);
  CurveTree tree;
  const auto in_frame = [&](const Vector3d& p) -> Vector3d { return axes * p; };
  for (const auto& node : skeleton_.nodes.rowwise()) tree.nodes.push_back(in_frame(node));
  const Eigen::VectorXd radii = usable_radii(skeleton_);
  tree.radii.assign(radii.begin(), radii.end());
  tree.neighbours.resize(tree.nodes.size());
  const auto join = [&](int a, int b) {
    tree.neighbours[idx(a)].push_back(b);
    tree.neighbours[idx(b)].push_back(a);
  };
  const RootedTree& hanging = rooted(axes.row(1).transpose());
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    if (hanging.parent[idx(node)] >= 0) join(node, hanging.parent[idx(node)]);
  }
  for (std::size_t k = 0; k < hanging.roots.size(); ++k) {
    if (hanging.above[k] >= 0) join(hanging.roots[k], hanging.above[k]);
  }
  for (const auto& edge : skeleton_.edges.rowwise()) {
    const std::vector<int>& joined = tree.neighbours[idx(edge[0])];
    if (std::find(joined.begin(), joined.end(), edge[1]) != joined.end()) continue;
    tree.cuts.insert(tree.cuts.end(), {edge[0], edge[1]});
  }
  std::sort(tree.cuts.begin(), tree.cuts.end());
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  for (const auto& position : surface_.positions.rowwise()) {
    const Vector3d p = in_frame(position);
    tree.vertices.push_back(p);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  tree.node_of_vertex.assign(tree.vertices.size(), -1);
  for (Eigen::Index v = 0; v < skeleton_.node_of_vertex.size(); ++v) {
    tree.node_of_vertex[idx(v)] = skeleton_.node_of_vertex[v];
  }
  for (const Vector3d& p : spread_) tree.spread.push_back(in_frame(p));
  const auto nodes = static_cast<Eigen::Index>(tree.nodes.size());
  const auto components = static_cast<Eigen::Index>(hanging.roots.size());
  tree.component = component_of_node(skeleton_);
  tree.own_nodes = static_cast<int>(nodes);
  tree.cycles = static_cast<int>(skeleton_.edges.rows() - (nodes - components));
  tree.size = (high - low).maxCoeff();
  tree.ground = low.y();
  tree.height = high.y() - low.y();
  tree.middle = 0.5 * (low.x() + high.x());
  return tree;
}

std::vector<int> Ways::path(int to) const {
  std::vector<int> nodes{to};
  while (before[idx(nodes.back())] >= 0) nodes.push_back(before[idx(nodes.back())]);
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<int> Ways::between(int from, int to) const {
  const std::vector<int> there = path(from);
  const std::vector<int> on = path(to);
  const auto [fork, fork_on] = std::mismatch(there.begin(), there.end(), on.begin(), on.end());
  if (fork == there.begin()) return {to};
  std::vector<int> nodes(there.rbegin(), std::make_reverse_iterator(fork - 1));
  nodes.insert(nodes.end(), fork_on, on.end());
  return nodes;
}

Ways ways_from(const CurveTree& tree, int node) {
  Ways ways;
  ways.before.assign(tree.nodes.size(), -1);
  ways.distance.assign(tree.nodes.size(), std::numeric_limits<double>::infinity());
  ways.distance[idx(node)] = 0;
  std::vector<int> open{node};
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    for (const int next : tree.neighbours[idx(at)]) {
      if (ways.distance[idx(next)] < std::numeric_limits<double>::infinity()) continue;
      ways.before[idx(next)] = at;
      ways.distance[idx(next)] =
          ways.distance[idx(at)] + (tree.nodes[idx(next)] - tree.nodes[idx(at)]).norm();
      open.push_back(next);
    }
  }
  return ways;
}

std::vector<int> part_of(const CurveTree& tree, int node, std::vector<char>& seen) {
  std::vector<int> part{node};
  seen[idx(node)] = 1;
  for (std::size_t k = 0; k < part.size(); ++k) {
    for (const int next : tree.neighbours[idx(part[k])]) {
      if (seen[idx(next)] != 0) continue;
      seen[idx(next)] = 1;
      part.push_back(next);
    }
  }
  return part;
}

std::vector<char> nodes_of_side(const CurveTree& tree, const Limbs& limbs,
                                const std::vector<int>& way) {
  std::vector<char> seen = limbs.is_trunk;
  std::vector<char> is_own(tree.nodes.size(), 0);
  for (const int first : way) {
    if (seen[idx(first)] != 0) continue;
    for (const int node : part_of(tree, first, seen)) is_own[idx(node)] = 1;
  }
  return is_own;
}

namespace {

struct Sampled {
  std::vector<double> way;  // from the beginning
  double whole = 0;
};

Sampled ways_along(const CurveTree& tree, const std::vector<int>& path) {
  Sampled sampled;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k > 0) {
      sampled.whole += (tree.nodes[idx(path[k])] - tree.nodes[idx(path[k - 1])]).norm();
    }
    sampled.way.push_back(sampled.whole);
  }
  return sampled;
}

/// Stations along a way; those of a right one are mirrored.
Course course_along(const CurveTree& tree, const std::vector<int>& path, bool is_left) {
  constexpr std::size_t samples = 400;
  Course course{std::vector<Vector3d>(samples), std::vector<double>(samples)};
  const Sampled along = ways_along(tree, path);
  std::size_t k = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double way = along.whole * static_cast<double>(i) / (samples - 1);
    while (k + 2 < path.size() && along.way[k + 1] < way) ++k;
    const std::size_t next = std::min(k + 1, path.size() - 1);
    const double step = along.way[next] - along.way[k];
    const double share = step > 0 ? std::clamp((way - along.way[k]) / step, 0.0, 1.0) : 0;
    Vector3d point = (1 - share) * tree.nodes[idx(path[k])] + share * tree.nodes[idx(path[next])];
    if (!is_left) point.x() = 2 * tree.middle - point.x();
    course.points[i] = point;
    course.radii[i] = (1 - share) * tree.radii[idx(path[k])] + share * tree.radii[idx(path[next])];
  }
  return course;
}

}  // namespace

Course side_course(const CurveTree& tree, const LimbWay& limb, bool is_left) {
  return course_along(tree, is_left ? limb.path : limb.mirror, is_left);
}

Course mean_course(const CurveTree& tree, const LimbWay& limb) {
  Course course = side_course(tree, limb, true);
  const Course image = side_course(tree, limb, false);
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    course.points[i] = 0.5 * course.points[i] + 0.5 * image.points[i];
    course.radii[i] = 0.5 * course.radii[i] + 0.5 * image.radii[i];
  }
  return course;
}

double share_within_both(const CurveTree& tree, const LimbWay& limb) {
  const Course course = side_course(tree, limb, true);
  const Course image = side_course(tree, limb, false);
  int within = 0;
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    const double off = 0.5 * (course.points[i] - image.points[i]).norm();
    within += off < std::min(course.radii[i], image.radii[i]) ? 1 : 0;
  }
  return within / static_cast<double>(course.points.size());
}

std::size_t last_shared(const Course& course, const Course& other) {
  constexpr double near = 0.1;  // radii
  for (std::size_t k = course.points.size(); k-- > 1;) {
    for (const Vector3d& point : other.points) {
      if ((point - course.points[k]).norm() < near * course.radii[k]) return k;
    }
  }
  return 0;
}

}  // namespace curveskel
