// The links between the components of a skeleton: one tree of them all.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include "rig/joints/component_links.hpp"

namespace curveskel {

/// By component, none for the first: the least spanning tree of links, each between two balls of
/// different components. A link is as long as their gap, less than nothing where they overlap, but
/// no less than where the smaller is all inside; and longer by up to the radius of the smaller the
/// more sideways it leads from both curves: a finger hangs from the hand in front of which it is,
/// not from the finger beside it. Of a link the component's own end goes on to the tip of its curve
/// within two radii, else to the junction within one.
/// Two components whose surfaces come near (`skeleton.contacts`) are linked there instead: by their
/// gap, less twice the radius w of a disc as large as the section through which they meet (that of
/// the thicker ball at most), and longer by up to w the more sideways it leads. Where they face
/// each other along all of a curve that hangs from its upper end, as a limb does that lies beside
/// the body; `up` is a unit vector. Bodies of a scene stand apart: where the gap is more than a
/// quarter of the longer diagonal of the two bodies, whatever hangs from them included, one hangs
/// from none. Nor do those with a node of `ground`, and nothing hangs from them. Precondition: the
/// components are the skeleton's, by their nodes; radii by node, > 0. Nothing hangs from any but
/// the first 1000.
[[nodiscard]] std::vector<Hinge> hang_components(
    const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
    const std::vector<std::vector<int>>& components, const std::vector<int>& ground = {},
    const Eigen::Vector3d& up = Eigen::Vector3d::UnitY());

/// The same in several directions up, for which links are found once. Refers to the skeleton.
class HangingComponents {
 public:
  HangingComponents(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
                    const std::vector<std::vector<int>>& components,
                    const std::vector<int>& ground);
  HangingComponents(const HangingComponents&) = delete;
  HangingComponents& operator=(const HangingComponents&) = delete;
  HangingComponents(HangingComponents&&) = delete;
  HangingComponents& operator=(HangingComponents&&) = delete;
  ~HangingComponents() = default;

  [[nodiscard]] std::vector<Hinge> hinges(const Eigen::Vector3d& up) const;

 private:
  [[nodiscard]] Hinge at_contact(const ComponentLink& link, const Eigen::Vector3d& up) const;
  [[nodiscard]] Hinge moved_to_end(Hinge hinge) const;
  void let_go(std::vector<Hinge>& hinges) const;

  const CurveGraph curves_;
  const Eigen::VectorXd radii_;
  const ComponentLinks links_;
};

}  // namespace curveskel
