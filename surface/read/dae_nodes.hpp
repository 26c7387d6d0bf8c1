// The nodes of a COLLADA file where its scene shows them. Internal to surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <unordered_map>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/dae_document.hpp"

namespace curveskel {

/// A node where the scene shows it.
struct DaeNode {
  const XmlElement* element = nullptr;
  Eigen::Affine3d frame;  ///< from the node to the world
  int parent = -1;        ///< its number; -1 = the scene itself, which is the first
};

/// Of elements that move nodes (<matrix>, <rotate>) the numbers in place of their own.
using MovedNumbers = std::unordered_map<const XmlElement*, std::vector<double>>;

/// All nodes of the scene, depth first, in the file's order; none in a file without a scene. Throws
/// Error(Fault::input) with the line.
[[nodiscard]] std::vector<DaeNode> dae_nodes(const DaeDocument& document, const Monitor& monitor,
                                             const MovedNumbers& moved = {});

}  // namespace curveskel
