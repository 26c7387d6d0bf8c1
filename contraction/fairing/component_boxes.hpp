// Each component of a surface in a box of its own, so that none loses digits to the others.
#pragma once

#include <vector>

#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// Moves each component to the origin and scales it by a power of two, which changes no digit, so
/// that the diagonal of its bounding box is above 1/2 and at most 1.
class ComponentBoxes {
 public:
  /// `parts` must outlive the boxes. Precondition: no diagonal overflows.
  ComponentBoxes(const Positions& positions, const Topology& parts);

  /// #V by 3; the origin for vertices without faces, which are of no component.
  [[nodiscard]] Positions enter(const Positions& positions) const;
  /// Back to model units; undefined for vertices without faces.
  [[nodiscard]] Positions leave(const Positions& positions) const;

 private:
  struct Box {
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    double scale = 0;
  };
  [[nodiscard]] const Box& of(Eigen::Index vertex) const;

  const Topology& parts_;
  std::vector<Box> boxes_;  // per component
};

}  // namespace curveskel
