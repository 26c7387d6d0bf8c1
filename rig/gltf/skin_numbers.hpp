// The numbers of a rig as glTF has them: rows of joints and weights, frames, inverse bind matrices.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// JOINTS_0 and WEIGHTS_0 of some vertices.
struct SkinRows {
  std::string joints;   ///< four of each vertex: bytes, or words where there are more than 256
  std::string weights;  ///< four floats of each vertex
  bool in_words = false;
};

/// `four_weights` of each row from `first` on.
[[nodiscard]] SkinRows skin_rows(const SkinWeights& weights, Eigen::Index first, Eigen::Index count,
                                 const std::vector<int>& joints = {});

/// These rows, in this order.
[[nodiscard]] SkinWeights chosen_rows(const SkinWeights& weights, const std::vector<int>& rows);

/// A joint in the frame of its parent.
struct LocalFrame {
  Eigen::Vector3d offset;
  Eigen::Quaterniond turn;
};

/// At rest, turned by the rig's `turns`. `axes` are those of `bone_axes`.
[[nodiscard]] std::vector<LocalFrame> local_frames(const Rig& rig,
                                                   const std::vector<Eigen::Quaterniond>& axes);

/// Inverse frame times `move` of each joint, 16 floats by columns: `move` takes the positions of
/// the file to where the joints are.
[[nodiscard]] std::string inverse_bind_matrices(const Rig& rig,
                                                const std::vector<Eigen::Quaterniond>& axes,
                                                const Eigen::Affine3d& move);

/// Throws Error(Fault::output) where there are more than 65,536 joints, or where one lies beyond
/// single precision.
void require_gltf_joints(const Rig& rig);

}  // namespace curveskel
