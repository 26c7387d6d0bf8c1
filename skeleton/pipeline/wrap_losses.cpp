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
#include "skeleton/graph/skeleton_segments.hpp"

namespace curveskel {
namespace {

/// The end of a branch, the length of the branch, and whether all of it is inside.
struct Tip {
  Eigen::Vector3d place;
  double length = 0;
  bool inside = true;
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
    const bool inside = std::ranges::all_of(branch.nodes, [&](int node) {
      return skeleton.radii.size() == 0 || skeleton.radii(node) > 0;
    });
    for (const int end : {branch.nodes.front(), branch.nodes.back()}) {
      if (degree(end) == 1) result.push_back({skeleton.nodes.row(end), length, inside});
    }
  }
  return result;
}

/// Of the tips of branches that are longer than `shortest` and inside, those that have no tip of
/// the other curve near them: one each, so that a tip between two legs stands for one of them only.
std::size_t tips_lost(const CurveSkeleton& own, const CurveSkeleton& other, double shortest) {
  std::vector<Tip> limbs = tips(own);
  std::erase_if(limbs, [&](const Tip& tip) { return tip.length < shortest || !tip.inside; });
  const std::vector<Tip> candidates = tips(other);
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> near(limbs.size() +
                                                                           candidates.size());
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      const double apart = (limbs[i].place - candidates[j].place).norm();
      if (apart <= std::max(shortest, limbs[i].length / 2)) {
        boost::add_edge(i, limbs.size() + j, near);
      }
    }
  }
  std::vector<std::size_t> mate(boost::num_vertices(near));
  boost::edmonds_maximum_cardinality_matching(near, mate.data());
  return limbs.size() - boost::matching_size(near, mate.data());
}

/// The share of the area that lies much farther from one curve than from the other.
double share_left(const Surface& surface, const CurveSkeleton& own, const CurveSkeleton& other,
                  double much) {
  const SkeletonSegments near(own);
  const SkeletonSegments far(other);
  double whole = 0;
  double left = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    const Eigen::Vector3d a = surface.positions.row(t(0));
    const Eigen::Vector3d b = surface.positions.row(t(1));
    const Eigen::Vector3d c = surface.positions.row(t(2));
    const double weight = (b - a).cross(c - a).norm();
    const Eigen::Vector3d middle = (a + b + c) / 3;
    whole += weight;
    if (far.distance(middle) > near.distance(middle) + much) left += weight;
  }
  return whole > 0 ? left / whole : 0;
}

}  // namespace

std::string losses_by_wrap(const FailingComponent& failing, const CurveSkeleton& from_wrap) {
  constexpr double much = 0.05;   // of the component's extent: a limb, no spike of noise
  constexpr double limb = 0.005;  // of the area
  const double diagonal = bounding_box_diagonal(failing.surface.positions);
  const std::size_t lost = tips_lost(failing.skeleton, from_wrap, much * diagonal);
  if (lost > 0) {
    return "the wrap joins or loses limbs: " + std::to_string(lost) +
           " tips of the surface's own curve have none of the wrap's beside them";
  }
  const double left = share_left(failing.surface, failing.skeleton, from_wrap, much * diagonal);
  if (left <= limb) return {};
  return "the wrap's curve leaves parts out: " + std::to_string(std::lround(1000 * left)) +
         " thousandths of the area given are far from it";
}

}  // namespace curveskel
