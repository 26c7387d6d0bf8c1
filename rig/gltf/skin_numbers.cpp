#include "rig/gltf/skin_numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "rig/gltf/number_bytes.hpp"
#include "rig/skin/four_weights.hpp"
#include "surface/mesh/single_precision.hpp"

namespace curveskel {

SkinRows skin_rows(const SkinWeights& weights, Eigen::Index first, Eigen::Index count,
                   const std::vector<int>& joints) {
  constexpr int most_in_bytes = 256;
  SkinRows rows;
  const int last = joints.empty() ? static_cast<int>(weights.cols()) - 1
                                  : *std::max_element(joints.begin(), joints.end());
  rows.in_words = last >= most_in_bytes;
  for (Eigen::Index vertex = first; vertex < first + count; ++vertex) {
    const FourWeights four = four_weights(weights, vertex, joints);
    for (const float weight : four.weights) put_number(rows.weights, weight);
    for (const int joint : four.joints) {
      if (rows.in_words) {
        put_number(rows.joints, static_cast<std::uint16_t>(joint));
      } else {
        put_number(rows.joints, static_cast<std::uint8_t>(joint));
      }
    }
  }
  return rows;
}

SkinWeights chosen_rows(const SkinWeights& weights, const std::vector<int>& rows) {
  SkinWeights chosen(static_cast<Eigen::Index>(rows.size()), weights.cols());
  chosen.reserve(Eigen::VectorXi::Constant(chosen.rows(), 4));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (SkinWeights::InnerIterator it(weights, rows[row]); it; ++it) {
      chosen.insert(static_cast<Eigen::Index>(row), it.col()) = it.value();
    }
  }
  chosen.makeCompressed();
  return chosen;
}

std::vector<LocalFrame> local_frames(const Rig& rig, const std::vector<Eigen::Quaterniond>& axes) {
  const auto turned = [&](int joint) {
    const Eigen::Quaterniond& bound = axes[idx(joint)];
    return rig.turns.empty() ? bound : (rig.turns[idx(joint)] * bound).normalized();
  };
  std::vector<LocalFrame> frames;
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    const int parent = rig.parents[joint];
    LocalFrame frame{rig.joints.row(joint).transpose(), turned(joint)};
    if (parent >= 0) {
      // The place in the parent's frame is the same in any pose.
      frame.offset =
          axes[idx(parent)].conjugate() * (frame.offset - rig.joints.row(parent).transpose());
      frame.turn = (turned(parent).conjugate() * frame.turn).normalized();
    }
    frames.push_back(frame);
  }
  return frames;
}

std::string inverse_bind_matrices(const Rig& rig, const std::vector<Eigen::Quaterniond>& axes,
                                  const Eigen::Affine3d& move) {
  std::string matrices;
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    const Eigen::Vector3d place = rig.joints.row(joint).transpose();
    const Eigen::Affine3d back(axes[idx(joint)].conjugate() * Eigen::Translation3d(-place));
    const Eigen::Matrix4d inverse_bind = (back * move).matrix();
    for (const double number : inverse_bind.reshaped())
      put_number(matrices, static_cast<float>(number));
  }
  return matrices;
}

void require_gltf_joints(const Rig& rig) {
  constexpr Eigen::Index most_joints = 65536;
  if (rig.joints.rows() > most_joints) {
    throw Error(Fault::output, std::to_string(rig.joints.rows()) + " joints, needed at most " +
                                   std::to_string(most_joints) +
                                   "; choose fewer components or longer bones");
  }
  require_single_range(rig.joints, "glTF");
}

}  // namespace curveskel
