#include "skeleton/match/branch_laying.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// Of the whole curve.
double length_nearest_to(const BranchCurve& curve, const Eigen::Vector3d& place) {
  double best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k + 1 < curve.points.rows(); ++k) {
    const Eigen::Vector3d from = curve.points.row(k);
    const Eigen::Vector3d way = curve.points.row(k + 1).transpose() - from;
    const double square = way.squaredNorm();
    const double share = square > 0 ? std::clamp((place - from).dot(way) / square, 0.0, 1.0) : 0;
    const double distance = (from + share * way - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = curve.lengths[idx(k)] + share * way.norm();
  }
  return best;
}

/// Calls visit(s, t, motion) for nodes evenly along the branch: the node's length on its own curve,
/// that on the partner nearest to where its motion takes it, and the motion.
template <typename Visit>
void for_moved_nodes(const Branch& one, const BranchCurve& from, const BranchCurve& to,
                     const NodeMotions& motions, const Visit& visit) {
  constexpr std::size_t most = 64;
  const std::size_t step = (one.nodes.size() + most - 1) / most;
  for (std::size_t k = 0; k + 1 < one.nodes.size(); k += step) {
    const Similarity& motion = motions.of_node[idx(one.nodes[k])];
    const Eigen::Vector3d place = from.points.row(static_cast<Eigen::Index>(k));
    visit(from.lengths[k], length_nearest_to(to, motion(place)), motion);
  }
}

bool starts_at_junction(const BranchOnSide& one) {
  const int start = one.branch.nodes.front();
  return (one.side.skeleton.edges.array() == start).count() >= 3;
}

}  // namespace

BranchLaying laying_of(const BranchOnSide& one, const BranchOnSide& other, bool reversed,
                       const NodeMotions& motions) {
  const BranchCurve& from = one.curve;
  const BranchCurve& to = other.curve;
  BranchLaying laying{reversed ? to.length() : 0, reversed};
  const bool is_ring = from.closed && to.closed && from.length() > 0 && to.length() > 0;
  if (!is_ring || (starts_at_junction(one) && starts_at_junction(other))) return laying;
  const BranchLaying from_zero{0, reversed};
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for_moved_nodes(one.branch, from, to, motions, [&](double s, double t, const Similarity&) {
    const double start = t - from_zero.length_on_partner(from, to, s);
    const double angle = 2 * std::numbers::pi * start / to.length();
    sum += Eigen::Vector2d(std::cos(angle), std::sin(angle));
  });
  laying.start = std::atan2(sum.y(), sum.x()) / (2 * std::numbers::pi) * to.length();
  return laying;
}

bool goes_round_against(const Branch& one, const BranchCurve& from, const BranchCurve& to,
                        const NodeMotions& motions) {
  double along = 0;
  for_moved_nodes(one, from, to, motions, [&](double s, double t, const Similarity& motion) {
    const Eigen::Vector3d here = motion.rotation * derivatives_at(from, s).first;
    along += here.normalized().dot(derivatives_at(to, t).first.normalized());
  });
  return along < 0;
}

}  // namespace curveskel
