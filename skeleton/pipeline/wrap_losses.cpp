#include "skeleton/pipeline/wrap_losses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>

namespace curveskel {
namespace {

/// The end of a branch, and the branch.
struct Tip {
  Eigen::Vector3d place;
  double length = 0;
  std::vector<int> nodes;
};

std::vector<Tip> tips(const CurveSkeleton& skeleton) {
  Eigen::VectorXi degree = Eigen::VectorXi::Zero(skeleton.nodes.rows());
  for (const std::int32_t node : skeleton.edges.reshaped()) ++degree(node);
  std::vector<Tip> result;
  for (const Branch& branch : branches(skeleton)) {
    double length = 0;
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
      length +=
          (skeleton.nodes.row(branch.nodes[i]) - skeleton.nodes.row(branch.nodes[i - 1])).norm();
    }
    for (const int end : {branch.nodes.front(), branch.nodes.back()}) {
      if (degree(end) == 1) result.push_back({skeleton.nodes.row(end), length, branch.nodes});
    }
  }
  return result;
}

/// Of the tips of branches that are inside and reach farther than `shortest` beyond the ball at
/// their other end, those that have no tip of the other curve near them: one each, so that a tip
/// between two legs stands for one of them only.
std::size_t tips_lost(const FailingComponent& failing, const CurveSkeleton& other,
                      double shortest) {
  const SurfaceTree tree(failing.surface);
  const auto clearance = [&](int node) {
    return tree.inscribed_radius(failing.skeleton.nodes.row(node));
  };
  const auto inside = [&](int node) { return clearance(node) > 0; };
  std::vector<Tip> limbs = tips(failing.skeleton);
  std::erase_if(limbs, [&](const Tip& tip) {
    const double ball = std::max(clearance(tip.nodes.front()), clearance(tip.nodes.back()));
    return tip.length < ball + shortest || !std::ranges::all_of(tip.nodes, inside);
  });
  const std::vector<Tip> candidates = tips(other);
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> near(limbs.size() +
                                                                           candidates.size());
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      const double apart = (limbs[i].place - candidates[j].place).norm();
      if (apart <= std::max(shortest, limbs[i].length)) {
        boost::add_edge(i, limbs.size() + j, near);
      }
    }
  }
  std::vector<std::size_t> mate(boost::num_vertices(near));
  boost::edmonds_maximum_cardinality_matching(near, mate.data());
  return limbs.size() - boost::matching_size(near, mate.data());
}

}  // namespace

std::string losses_by_wrap(const FailingComponent& failing, const CurveSkeleton& from_wrap,
                           const CertificateOptions& options, const Monitor& monitor) {
  constexpr double limb = 0.05;      // of the component's extent: no spike of noise
  constexpr double no_longer = 0.1;  // of the vertices
  const double diagonal = bounding_box_diagonal(failing.surface.positions);
  const std::size_t lost = tips_lost(failing, from_wrap, limb * diagonal);
  if (lost == 0) return {};
  const double own = evaluate(failing.surface, failing.skeleton, options, monitor).coverage;
  const double its = evaluate(failing.surface, from_wrap, options, monitor).coverage;
  if (its >= own - no_longer) return {};
  return "the wrap joins or loses limbs: " + std::to_string(lost) +
         " tips of the surface's own curve have none of the wrap's beside them, and " +
         std::to_string(std::lround(100 * (own - its))) +
         " % of the surface's vertices are no longer near the curve";
}

}  // namespace curveskel
