// Joints that move a surface.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// n x j, the joints' shares in each vertex: >= 0, of sum 1, or an empty row where none moves it.
using SkinWeights = Eigen::SparseMatrix<float, Eigen::RowMajor>;

/// A hierarchy of joints with skin weights (linear blend skinning).
struct Rig {
  Positions joints;                ///< j x 3, in the surface and its coordinates
  Eigen::VectorXi parents;         ///< j, each before its children; -1 = a root
  std::vector<std::string> names;  ///< j; may be empty strings
  SkinWeights weights;             ///< n x j
  /// j, what each is in a body, in the words of PlannedJoint::role; "" = nothing that is known.
  /// Those of a scene's second figure begin with "figure2_", and so on. Empty where nothing was
  /// looked for.
  std::vector<std::string> roles = {};
  /// j, in the surface's coordinates, about each joint: from the surface as it is to where it
  /// rests. Empty = it rests as it is.
  std::vector<Eigen::Quaterniond> turns = {};
  /// j, the names in readable words, with ".L" and ".R" for sides, where `names` are in other ones.
  /// Empty where they are not.
  std::vector<std::string> readable = {};
  /// From the surface's coordinates to those with y up, as glTF, USD and FBX files have them: a
  /// turn, and a scale to metres where the input states its unit. Formats that have joints alone
  /// keep the surface's.
  Eigen::Matrix3d to_y_up = Eigen::Matrix3d::Identity();
};

}  // namespace curveskel
