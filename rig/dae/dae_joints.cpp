#include "rig/dae/dae_joints.hpp"

#include <cstddef>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

std::vector<DaeJoint> dae_joints(const std::vector<DaeNode>& nodes) {
  std::vector<DaeJoint> joints;
  std::vector<int> number;  // of each node its own, or that of the nearest joint above it
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int above = nodes[k].parent < 0 ? -1 : number[idx(nodes[k].parent)];
    const bool is_joint = nodes[k].element->attribute("type") == "JOINT";
    number.push_back(is_joint ? static_cast<int>(joints.size()) : above);
    if (is_joint) joints.push_back({static_cast<int>(k), above});
  }
  return joints;
}

}  // namespace curveskel
