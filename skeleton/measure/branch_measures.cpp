#include <curveskel/branch_measures.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/measure/branch_curve.hpp"
#include "skeleton/measure/branch_orders.hpp"

namespace curveskel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

BranchKind kind_of(const Branch& branch, const std::vector<int>& degree) {
  const int at_start = degree[idx(branch.nodes.front())];
  const int at_end = degree[idx(branch.nodes.back())];
  if (at_start == 1 && at_end == 1) return BranchKind::chain;
  if (at_start == 1 || at_end == 1) return BranchKind::leaf;
  return at_start == 2 ? BranchKind::ring : BranchKind::inner;
}

/// Of each node of a curve: half the edges beside it, over the length.
std::vector<double> shares_of_nodes(const BranchCurve& curve) {
  const std::size_t count = curve.lengths.size();
  std::vector<double> shares(count, 0);
  for (std::size_t k = 1; k < count; ++k) {
    const double share = curve.length() > 0
                             ? (curve.lengths[k] - curve.lengths[k - 1]) / curve.length()
                             : 1 / static_cast<double>(count - 1);
    shares[k - 1] += share / 2;
    shares[k] += share / 2;
  }
  return shares;
}

void measure_radii(const BranchCurve& curve, BranchMeasures& measures) {
  measures.mean_radius = measures.least_radius = measures.largest_radius = none;
  if (curve.radii.size() == 0) return;
  measures.least_radius = curve.radii.minCoeff();
  measures.largest_radius = curve.radii.maxCoeff();
  const std::vector<double> shares = shares_of_nodes(curve);
  measures.mean_radius = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    measures.mean_radius += shares[k] * curve.radii[static_cast<Eigen::Index>(k)];
  }
}

double curvature_of(const CurveDerivatives& by_length) {
  const double speed = by_length.first.norm();
  if (!(speed > 0)) return 0;
  return by_length.first.cross(by_length.second).norm() / (speed * speed * speed);
}

/// A third derivative of a thin tube's curve, over two of its radii, is the noise of its nodes:
/// those over a stretch on which the bend itself shows. Noise bends, too, so that the stretch grows
/// from that of `by_length` until the bend is the same on it.
CurveDerivatives derivatives_over_bend(const BranchCurve& curve, double s,
                                       CurveDerivatives by_length) {
  constexpr double share = 0.3;  // of the radius of curvature, on either side
  constexpr double settled = 1.1;
  constexpr int rounds = 6;
  double half = 0;
  for (int round = 0; round < rounds; ++round) {
    const double curvature = curvature_of(by_length);
    const double wanted = std::min(share / curvature, curve.length());
    if (!(curvature > 0) || wanted <= settled * half) break;
    half = wanted;
    by_length = derivatives_at(curve, s, half);
  }
  return by_length;
}

void measure_bends(const BranchCurve& curve, BranchMeasures& measures) {
  const std::vector<double> shares = shares_of_nodes(curve);
  double twist = 0;
  double weights = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double s = curve.lengths[k];
    const CurveDerivatives near = derivatives_at(curve, s);
    measures.curvature += shares[k] * curvature_of(near);
    const CurveDerivatives wide = derivatives_over_bend(curve, s, near);
    const Eigen::Vector3d binormal = wide.first.cross(wide.second);
    twist += shares[k] * binormal.dot(wide.third);
    weights += shares[k] * binormal.squaredNorm();
  }
  // Rounding alone bends a straight branch by about 1e-16 over its nodes' distance.
  const bool bent = measures.curvature * measures.length > 1e-9;
  measures.torsion = bent ? twist / weights : none;
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// Between a branch and the one that it hangs from, at the node that they share.
double angle_between(const Branch& child, const BranchCurve& of_child, const Branch& parent,
                     const BranchCurve& of_parent) {
  for (const bool at_start : {true, false}) {
    const int node = at_start ? child.nodes.front() : child.nodes.back();
    for (const bool parent_at_start : {true, false}) {
      if (node != (parent_at_start ? parent.nodes.front() : parent.nodes.back())) continue;
      return degrees_between(departure(of_child, at_start), departure(of_parent, parent_at_start));
    }
  }
  return none;
}

}  // namespace

std::vector<BranchMeasures> branch_measures(const CurveSkeleton& skeleton, int root) {
  require_sound(skeleton, "branch_measures");
  if (root < -1 || root >= skeleton.nodes.rows()) {
    throw Error(Fault::usage, "branch_measures: the root is " + std::to_string(root) +
                                  ", needed one of the " + std::to_string(skeleton.nodes.rows()) +
                                  " nodes, or -1 for none");
  }
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  const std::vector<Branch> all_branches = branches(skeleton);
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  const BranchOrders orders = branch_orders(skeleton, all_branches, root);
  std::vector<BranchCurve> curves;
  curves.reserve(all_branches.size());
  for (const Branch& branch : all_branches) curves.push_back(branch_curve(skeleton, branch));

  std::vector<BranchMeasures> all;
  for (std::size_t b = 0; b < all_branches.size(); ++b) {
    const BranchCurve& curve = curves[b];
    BranchMeasures measures;
    measures.kind = kind_of(all_branches[b], degree);
    measures.length = curve.length();
    measures.chord = (curve.points.bottomRows<1>() - curve.points.topRows<1>()).norm();
    measures.tortuosity =
        measures.chord > 0 ? std::max(0.0, measures.length / measures.chord - 1) : none;
    measure_radii(curve, measures);
    measure_bends(curve, measures);
    const int parent = levels[b].parent;
    measures.parent_angle =
        parent < 0
            ? none
            : angle_between(all_branches[b], curve, all_branches[idx(parent)], curves[idx(parent)]);
    measures.centrifugal_order = orders.centrifugal[b];
    measures.strahler_order = orders.strahler[b];
    all.push_back(measures);
  }
  return all;
}

std::vector<JunctionMeasures> junction_measures(const CurveSkeleton& skeleton) {
  require_sound(skeleton, "junction_measures");
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<JunctionMeasures> of_node(idx(skeleton.nodes.rows()));
  std::vector<std::vector<Eigen::Vector3d>> directions(of_node.size());
  const std::vector<Branch> all_branches = branches(skeleton);
  for (std::size_t b = 0; b < all_branches.size(); ++b) {
    const BranchCurve curve = branch_curve(skeleton, all_branches[b]);
    for (const bool at_start : {true, false}) {
      const auto& nodes = all_branches[b].nodes;
      const std::size_t node = idx(at_start ? nodes.front() : nodes.back());
      of_node[node].branches.push_back(static_cast<int>(b));
      directions[node].push_back(departure(curve, at_start));
    }
  }
  std::vector<JunctionMeasures> junctions;
  for (std::size_t node = 0; node < of_node.size(); ++node) {
    if (degree[node] < 3) continue;
    JunctionMeasures& junction = of_node[node];
    junction.node = static_cast<int>(node);
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < directions[node].size(); ++i) {
      scatter += directions[node][i] * directions[node][i].transpose();
      for (std::size_t k = i + 1; k < directions[node].size(); ++k) {
        junction.angles.push_back(degrees_between(directions[node][i], directions[node][k]));
      }
    }
    scatter /= static_cast<double>(directions[node].size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(scatter, Eigen::EigenvaluesOnly);
    junction.planarity = 1 - 3 * std::max(0.0, spectrum.eigenvalues()[0]);
    junctions.push_back(std::move(junction));
  }
  return junctions;
}

}  // namespace curveskel
