// The places of a primitive's vertices in the scene: morphed, then moved by the joints of the skin,
// or by the node where there is none (glTF 2.0, section 3.7.3.3).
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace curveskel {

/// The moves that take a skin's vertices from where they were modelled to their places.
struct GltfSkinPose {
  std::vector<Eigen::Affine3d> joints;  ///< frame of the joint times its inverse bind matrix
  Eigen::Affine3d without_weights;      ///< of meshes that have no weights, as Blender places them
  Eigen::Affine3d topmost;              ///< that of the joint with the fewest nodes above it
};

/// By columns a linear map and a shift; sums of joints' moves are none of the kinds that have
/// names.
using GltfMove = Eigen::Matrix<double, 3, 4>;

struct GltfPlaced {
  std::vector<Eigen::Vector3d> modelled;  ///< morphed, not yet moved
  std::vector<Eigen::Vector3d> positions;
  bool mirrored = false;  ///< the faces look inwards unless they are turned round
  bool bent = false;      ///< no one move takes all from `modelled` to `positions`
  Eigen::Affine3d move = Eigen::Affine3d::Identity();  ///< that move, where not `bent`
};

/// `frames` and `parents` are those of `GltfScene`.
/// Throws Error(Fault::input) where the skin lacks joints or matrices, or one is not affine.
[[nodiscard]] GltfSkinPose skin_pose(const FileBytes& file, const tinygltf::Model& model, int skin,
                                     const std::vector<Eigen::Affine3d>& frames,
                                     const std::vector<int>& parents);

/// Where all joints that have weights move the primitive's bounding box alike, to 1e-5 of its
/// diagonal, that one move is taken for all vertices, and none if it is none: a rig that rests as
/// it was bound keeps its coordinates bit by bit. A vertex without weights, in a primitive that has
/// some, goes with the first joint that its row names, as in three.js. `frame` is the node's; null
/// for `skin`: not skinned. Throws Error(Fault::input) where numbers are wrong.
[[nodiscard]] GltfPlaced placed_positions(const FileBytes& file, const tinygltf::Model& model,
                                          const tinygltf::Primitive& primitive,
                                          const std::vector<double>& morph_weights,
                                          const Eigen::Affine3d& frame, const GltfSkinPose* skin,
                                          const Monitor& monitor);

/// The move of each vertex, also where one is the same for all.
/// Throws Error(Fault::input) as `placed_positions`.
[[nodiscard]] std::vector<GltfMove> vertex_moves(const FileBytes& file,
                                                 const tinygltf::Model& model,
                                                 const tinygltf::Primitive& primitive,
                                                 const GltfSkinPose& skin, std::size_t vertices);

/// All that the places of the primitive's vertices in its mesh depend on: primitives for which this
/// is equal share their vertices.
[[nodiscard]] std::vector<int> accessors_of_positions(const tinygltf::Primitive& primitive);

/// Every row of the primitive's joints and weights: `visit(vertex, joint, weight)`, joints by their
/// number in the skin, weights of zero too. Throws Error(Fault::input) where one is out of range.
void for_each_weight(const FileBytes& file, const tinygltf::Model& model,
                     const tinygltf::Primitive& primitive, std::size_t joint_count,
                     const std::function<void(std::size_t, std::size_t, double)>& visit);

}  // namespace curveskel
