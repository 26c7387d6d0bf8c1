#include "rig/gltf/hanging_parts.hpp"

#include <cstddef>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// By vertex of the document; -1 = none.
std::vector<int> joint_of_vertex(std::size_t vertices, const DressedDocument& document,
                                 const std::vector<DressedPart>& parts) {
  std::vector<int> joint_of_node(document.document.json["nodes"].size(), -1);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const int node = document.node_of_part[part];
    if (node >= 0) joint_of_node[idx(node)] = parts[part].joint;
  }
  std::vector<int> joints(vertices, -1);
  for (const GltfPart& part : document.parts) {
    for (auto v = part.first_vertex; v < part.first_vertex + part.count; ++v) {
      joints[idx(v)] = joint_of_node[idx(part.node)];
    }
  }
  return joints;
}

}  // namespace

SkinWeights with_hanging_parts(const SkinWeights& weights, const DressedDocument& document,
                               const std::vector<DressedPart>& parts) {
  const std::vector<int> joints = joint_of_vertex(idx(weights.rows()), document, parts);
  SkinWeights made(weights.rows(), weights.cols());
  made.reserve(weights.nonZeros());
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    made.startVec(v);
    const int joint = joints[idx(v)];
    if (joint >= 0) {
      made.insertBack(v, joint) = 1;
      continue;
    }
    for (SkinWeights::InnerIterator entry(weights, v); entry; ++entry) {
      made.insertBack(v, entry.col()) = entry.value();
    }
  }
  made.finalize();
  return made;
}

}  // namespace curveskel
