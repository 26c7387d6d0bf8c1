#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <curveskel/edit.hpp>
#include "base/indices.hpp"
#include "skeleton/graph/draft.hpp"

namespace curveskel {
namespace {

struct Way {
  int node;
  double length;
};

/// Per node, where its edges lead and how far that is.
std::vector<std::vector<Way>> ways_from(const CurveSkeleton& skeleton) {
  std::vector<std::vector<Way>> ways(idx(skeleton.nodes.rows()));
  for (const auto& edge : skeleton.edges.rowwise()) {
    const double length = (skeleton.nodes.row(edge[0]) - skeleton.nodes.row(edge[1])).norm();
    ways[idx(edge[0])].push_back({edge[1], length});
    ways[idx(edge[1])].push_back({edge[0], length});
  }
  return ways;
}

}  // namespace

Path shortest_path(const CurveSkeleton& skeleton, int a, int b) {
  require_node(skeleton, a, "shortest_path");
  require_node(skeleton, b, "shortest_path");
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto ways = ways_from(skeleton);
  std::vector<double> length(ways.size(), never);
  std::vector<int> before(ways.size(), -1);
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  length[idx(a)] = 0;
  open.emplace(0, a);
  while (!open.empty() && open.top().second != b) {
    const auto [so_far, node] = open.top();
    open.pop();
    if (so_far > length[idx(node)]) continue;
    for (const Way& way : ways[idx(node)]) {
      if (so_far + way.length >= length[idx(way.node)]) continue;
      length[idx(way.node)] = so_far + way.length;
      before[idx(way.node)] = node;
      open.emplace(length[idx(way.node)], way.node);
    }
  }
  Path path;
  if (length[idx(b)] == never) return path;
  path.length = length[idx(b)];
  for (int node = b; node >= 0; node = before[idx(node)]) path.nodes.push_back(node);
  std::reverse(path.nodes.begin(), path.nodes.end());
  return path;
}

}  // namespace curveskel
