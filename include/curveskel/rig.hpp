// Joints that move a surface.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// n x j, the joints' shares in each vertex: >= 0, of sum 1, or an empty row where none moves it.
using SkinWeights = Eigen::SparseMatrix<float, Eigen::RowMajor>;

/// A hierarchy of joints with skin weights (linear blend skinning).
struct Rig {
  Positions joints;                ///< j x 3, at rest, in the surface's coordinates
  Eigen::VectorXi parents;         ///< j, each before its children; -1 = a root
  std::vector<std::string> names;  ///< j; may be empty strings
  SkinWeights weights;             ///< n x j
  /// j, what each is in a body, in the words of PlannedJoint::role; "" = nothing that is known.
  /// Empty where nothing was looked for.
  std::vector<std::string> roles = {};
};

}  // namespace curveskel
