// Level sections of a body without its limbs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

struct BodySection {
  double right = 0;  ///< x
  double left = 0;
  double rear = 0;  ///< z
  double front = 0;

  [[nodiscard]] double width() const { return left - right; }
  /// x and z.
  [[nodiscard]] Eigen::Vector2d middle() const {
    return {0.5 * (left + right), 0.5 * (front + rear)};
  }
  /// The z next to this one that is a quarter of the depth or more from front and rear.
  [[nodiscard]] double depth_within(double z) const;
};

class BodySections {
 public:
  /// Of all that is nearest to other nodes than the limbs'. O(#N) for each of the spread points.
  /// Refers to the tree.
  BodySections(const CurveTree& tree, const std::vector<char>& is_limb);

  /// Without the outermost fortieth of its points to each side, which may be a sleeve's or a
  /// belt's. O(spread points).
  [[nodiscard]] BodySection at(double y) const;

  /// The height at which the body is narrowest between shoulders and a head that is wider.
  [[nodiscard]] std::optional<double> neck() const;

  /// The mean of the outermost point on the left and of the image of that on the right: the
  /// fingertips of arms that are held out.
  [[nodiscard]] Eigen::Vector3d outermost() const;

  /// Of the trunk from upright, in degrees: between the places of most of the surface at the
  /// heights of a human's hips and shoulders.
  [[nodiscard]] double lean() const;

  /// x of the middle of most sections of the trunk.
  [[nodiscard]] double mirror_plane() const;

 private:
  [[nodiscard]] Eigen::Vector2d middle_of_most(double y) const;

  const CurveTree& tree_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace curveskel
