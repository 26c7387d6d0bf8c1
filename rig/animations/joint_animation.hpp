// The joints of a file other than glTF over time. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

namespace curveskel {

/// By joint, in the order of `read_joints`: from the joint to the world, in the file's coordinates.
using JointFrames = std::vector<Eigen::Affine3d>;

struct JointAnimation {
  std::size_t clip = 0;  ///< its number among all of the file
  std::string name;      ///< may be empty
  std::vector<double> seconds;
  std::vector<JointFrames> frames;  ///< by second
};

struct AnimatedJoints {
  JointFrames rest;  ///< as the file's scene shows them
  std::vector<JointAnimation> animations;
};

}  // namespace curveskel
