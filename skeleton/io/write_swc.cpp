// SWC (Cannon et al. 1998): one sample per node, "id type x y z radius parent", parents first. A
// tree cannot hold loops: of each, the shortest edge that does the job is left out and named in a
// comment "# cut ID ID", which the reader closes again.
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <curveskel/advanced/union_find.hpp>
#include "base/decimal.hpp"
#include "base/one_line.hpp"
#include "skeleton/io/skeleton_formats.hpp"

namespace curveskel {
namespace {

struct SpanningForest {
  std::vector<std::vector<int>> neighbours;  ///< per node, over the edges kept
  std::vector<std::pair<int, int>> cuts;     ///< the edges left out, sorted
};

/// Kruskal's algorithm, the longest edges first.
SpanningForest longest_forest(const CurveSkeleton& skeleton) {
  const auto nodes = static_cast<std::size_t>(skeleton.nodes.rows());
  std::vector<int> order(static_cast<std::size_t>(skeleton.edges.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto length = [&](int e) {
    return (skeleton.nodes.row(skeleton.edges(e, 0)) - skeleton.nodes.row(skeleton.edges(e, 1)))
        .norm();
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length(a) > length(b); });

  UnionFind joined(skeleton.nodes.rows());
  SpanningForest forest{std::vector<std::vector<int>>(nodes), {}};
  for (const int e : order) {
    const int i = skeleton.edges(e, 0);
    const int j = skeleton.edges(e, 1);
    if (!joined.unite(i, j)) {
      forest.cuts.emplace_back(i, j);
      continue;
    }
    forest.neighbours[static_cast<std::size_t>(i)].push_back(j);
    forest.neighbours[static_cast<std::size_t>(j)].push_back(i);
  }
  std::sort(forest.cuts.begin(), forest.cuts.end());
  for (auto& list : forest.neighbours) std::sort(list.begin(), list.end(), std::greater<>());
  return forest;
}

struct SwcSample {
  int node;
  int parent;  ///< index of the parent's sample, -1 for a root
};

/// Depth first, so that the samples of a branch follow each other; a component's root is its
/// thickest node, but `chosen` (-1 = none) is one and comes first.
std::vector<SwcSample> depth_first_samples(const CurveSkeleton& skeleton,
                                           const SpanningForest& forest, int chosen) {
  const auto nodes = static_cast<std::size_t>(skeleton.nodes.rows());
  std::vector<int> roots(nodes);
  std::iota(roots.begin(), roots.end(), 0);
  if (skeleton.radii.size() > 0) {
    std::stable_sort(roots.begin(), roots.end(),
                     [&](int a, int b) { return skeleton.radii(a) > skeleton.radii(b); });
  }
  if (chosen >= 0) roots.insert(roots.begin(), chosen);
  std::vector<SwcSample> samples;
  std::vector<bool> seen(nodes, false);
  for (const int root : roots) {
    std::vector<SwcSample> stack{{root, -1}};
    while (!stack.empty()) {
      const SwcSample sample = stack.back();
      stack.pop_back();
      if (seen[static_cast<std::size_t>(sample.node)]) continue;
      seen[static_cast<std::size_t>(sample.node)] = true;
      const auto id = static_cast<int>(samples.size());
      samples.push_back(sample);
      for (const int next : forest.neighbours[static_cast<std::size_t>(sample.node)]) {
        if (!seen[static_cast<std::size_t>(next)]) stack.push_back({next, id});
      }
    }
  }
  return samples;
}

/// Stands for an unknown radius, since SWC needs one above 0: small against the skeleton.
double placeholder_radius(const CurveSkeleton& skeleton) {
  constexpr double share = 1e-6;
  const double extent =
      (skeleton.nodes.colwise().maxCoeff() - skeleton.nodes.colwise().minCoeff()).norm();
  return extent > 0 ? share * extent : share;
}

}  // namespace

std::string swc_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  constexpr int undefined_type = 0;
  std::string text;
  if (!context.provenance.empty()) text += "# " + in_one_line(context.provenance) + "\n";
  text += "# id type x y z radius parent\n";
  if (skeleton.nodes.rows() == 0) return text;

  const SpanningForest forest = longest_forest(skeleton);
  const std::vector<SwcSample> samples = depth_first_samples(skeleton, forest, context.root);
  std::vector<int> id_of_node(samples.size());
  std::string unknown;
  const double placeholder = placeholder_radius(skeleton);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const int node = samples[s].node;
    id_of_node[static_cast<std::size_t>(node)] = static_cast<int>(s) + 1;
    const bool known = skeleton.radii.size() > 0 && skeleton.radii(node) > 0;
    append_decimal(text, s + 1);
    text += ' ';
    append_decimal(text, undefined_type);
    text += ' ';
    append_decimals(text, skeleton.nodes.row(node), ' ');
    text += ' ';
    append_decimal(text, known ? skeleton.radii(node) : placeholder);
    text += ' ';
    append_decimal(text, samples[s].parent < 0 ? -1 : samples[s].parent + 1);
    text += '\n';
    if (!known) unknown.append(" ").append(std::to_string(s + 1));
  }
  if (!unknown.empty()) text += "# no radius" + unknown + "\n";
  for (const auto& [i, j] : forest.cuts) {
    const auto [low, high] = std::minmax(id_of_node[static_cast<std::size_t>(i)],
                                         id_of_node[static_cast<std::size_t>(j)]);
    text += "# cut " + std::to_string(low) + " " + std::to_string(high) + "\n";
  }
  return text;
}

}  // namespace curveskel
