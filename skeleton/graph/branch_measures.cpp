#include <curveskel/branch_measures.hpp>

#include <algorithm>
#include <limits>

namespace curveskel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<int> degrees(const CurveSkeleton& skeleton) {
  std::vector<int> degree(static_cast<std::size_t>(skeleton.nodes.rows()));
  for (const int node : skeleton.edges.reshaped()) ++degree[static_cast<std::size_t>(node)];
  return degree;
}

BranchKind kind_of(const Branch& branch, const std::vector<int>& degree) {
  const int at_start = degree[static_cast<std::size_t>(branch.nodes.front())];
  const int at_end = degree[static_cast<std::size_t>(branch.nodes.back())];
  if (at_start == 1 && at_end == 1) return BranchKind::chain;
  if (at_start == 1 || at_end == 1) return BranchKind::leaf;
  return at_start == 2 ? BranchKind::ring : BranchKind::inner;
}

void measure_radii(const CurveSkeleton& skeleton, const Branch& branch, BranchMeasures& measures) {
  measures.mean_radius = measures.least_radius = measures.largest_radius = none;
  if (skeleton.radii.size() == 0) return;
  const auto [least, largest] =
      std::minmax_element(branch.nodes.begin(), branch.nodes.end(),
                          [&](int a, int b) { return skeleton.radii[a] < skeleton.radii[b]; });
  measures.least_radius = skeleton.radii[*least];
  measures.largest_radius = skeleton.radii[*largest];
  measures.mean_radius = 0;
  for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
    const int a = branch.nodes[k - 1];
    const int b = branch.nodes[k];
    const double share =
        measures.length > 0
            ? (skeleton.nodes.row(b) - skeleton.nodes.row(a)).norm() / measures.length
            : 1 / static_cast<double>(branch.nodes.size() - 1);
    measures.mean_radius += share * (skeleton.radii(a) + skeleton.radii(b)) / 2;
  }
}

}  // namespace

std::vector<BranchMeasures> branch_measures(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  std::vector<BranchMeasures> all;
  for (const Branch& branch : branches(skeleton)) {
    const std::vector<int>& nodes = branch.nodes;
    BranchMeasures measures;
    measures.kind = kind_of(branch, degree);
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      measures.length += (skeleton.nodes.row(nodes[k]) - skeleton.nodes.row(nodes[k - 1])).norm();
    }
    measures.chord = (skeleton.nodes.row(nodes.back()) - skeleton.nodes.row(nodes.front())).norm();
    measures.tortuosity = measures.chord > 0 ? measures.length / measures.chord - 1 : none;
    measure_radii(skeleton, branch, measures);
    all.push_back(measures);
  }
  return all;
}

}  // namespace curveskel
