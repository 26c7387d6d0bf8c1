// The skeletons of a glTF file as USD has them. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "rig/gltf/whole_mesh.hpp"
#include "rig/usd/usd_text.hpp"
#include "surface/read/file_bytes.hpp"
#include "surface/read/gltf_scene.hpp"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace curveskel {

struct UsdSkeleton {
  std::string name;                      ///< of the prim
  std::vector<int> joints;               ///< nodes, parents first
  std::vector<int> above;                ///< of each joint the number of its parent; -1 = none
  std::vector<std::string> paths;        ///< "hips/spine"
  std::vector<std::string> names;        ///< the true ones
  std::vector<Eigen::Affine3d> bound;    ///< in the scene
  std::vector<Eigen::Affine3d> rest;     ///< in the joint above
  std::vector<std::vector<int>> chains;  ///< of each joint the nodes below the joint above, it last
  std::map<int, std::size_t> number_of_node;
};

struct UsdSkeletons {
  std::vector<UsdSkeleton> all;
  std::vector<bool> is_joint;           ///< by node
  std::vector<std::size_t> of_skin;     ///< by skin, one of `all`
  std::vector<Eigen::Affine3d> placed;  ///< by skin: from its meshes to the scene, as bound
};

/// One skeleton with all joints, whose nodes below that hold no mesh, or move, are joints of it,
/// too; skins that were bound in another pose than the first that shares a joint with them get one
/// of their own. `moved`: nodes that animations move.
[[nodiscard]] UsdSkeletons usd_skeletons(const FileBytes& file, const tinygltf::Model& model,
                                         const GltfScene& scene, const std::set<int>& moved);

/// A node in its parent.
[[nodiscard]] Eigen::Affine3d frame_of(const tinygltf::Node& node);

/// Its attributes; the prim is open.
void write_usd_skeleton(UsdText& text, const UsdSkeleton& skeleton);

/// Rows of `width` joints and weights of a vertex or place each, largest first, which sum to 1.
struct UsdWeights {
  std::size_t width = 1;
  std::vector<std::int32_t> joints;
  std::vector<double> weights;
};

/// `numbers`: of each of the skin's joints its number in the skeleton, -1 = not there.
[[nodiscard]] UsdWeights usd_weights(const WholeMesh& mesh, const std::vector<int>& numbers);

}  // namespace curveskel
