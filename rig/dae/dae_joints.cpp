#include "rig/dae/dae_joints.hpp"

#include <cstddef>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

bool is_dae_joint(const DaeNode& node) { return node.element->attribute("type") == "JOINT"; }

std::vector<DaeJoint> dae_joints(const std::vector<DaeNode>& nodes) {
  const std::vector<int> joint_of_node = dae_joint_of_node(nodes);
  std::vector<DaeJoint> joints;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int above = nodes[k].parent < 0 ? -1 : joint_of_node[idx(nodes[k].parent)];
    if (is_dae_joint(nodes[k])) joints.push_back({static_cast<int>(k), above});
  }
  return joints;
}

std::vector<int> dae_joint_of_node(const std::vector<DaeNode>& nodes) {
  std::vector<int> joint_of_node;
  int joints = 0;
  for (const DaeNode& node : nodes) {
    const int above = node.parent < 0 ? -1 : joint_of_node[idx(node.parent)];
    joint_of_node.push_back(is_dae_joint(node) ? joints++ : above);
  }
  return joint_of_node;
}

}  // namespace curveskel
