// Tips of a skeleton as matching sees them: by distances and radii over the size of the surface.
#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/match.hpp>

namespace curveskel {

/// All lengths over `unit`.
struct TipFeatures {
  double unit = 1;                  ///< the square root of the surface's area, in model units
  Graph graph;                      ///< of the skeleton
  std::vector<double> from_centre;  ///< per node: along the curve from the middle of its component
  Eigen::Vector3d centre;           ///< the middle of the largest component, in model units
  int centre_component = 0;
  std::vector<int> component;  ///< per node
  /// Per component: its middle node, its share of the area, the centroid of its area.
  std::vector<int> middle;
  std::vector<double> area_share;
  std::vector<Eigen::Vector3d> centroid;
  std::vector<int> tips;  ///< nodes
  Eigen::MatrixXd apart;  ///< tips x tips, along the curve; `unconnected` between components
  Eigen::MatrixXd radii;  ///< tips x samples: at even shares of the way to the middle
  Eigen::VectorXd reach;  ///< per tip: its distance from the middle
  /// 3 x tips, model units: where the way to the middle enters the core, or the tip within it.
  Eigen::Matrix3Xd roots;
  double core_radius = 0;  ///< from the middle, along the curve: holds `core_share` of the area
  std::vector<int> core_vertices;  ///< of the surface: those whose nodes lie in the core
};

inline constexpr double unconnected = 10;
/// Of the area. The middle of a body hardly bends: of a human it is the trunk and part of the
/// limbs.
inline constexpr double core_share = 0.35;

/// Throws Error(Fault::input) that says `name` for a skeleton without edges, radii or a vertex map.
[[nodiscard]] TipFeatures tip_features(const MatchSide& side, const std::string& name);

/// tips of a x tips of b, 0..1: how alike the ways of two tips to the middle are.
[[nodiscard]] Eigen::MatrixXd likeness(const TipFeatures& a, const TipFeatures& b);

/// Two bodies between which partners are looked for. Refers to what it is made of.
struct MatchedBodies {
  const MatchSide& a;
  const TipFeatures& of_a;
  const MatchSide& b;
  const TipFeatures& of_b;
  const Eigen::MatrixXd& like;  ///< see `likeness`
  const std::stop_token& stop;
};

}  // namespace curveskel
