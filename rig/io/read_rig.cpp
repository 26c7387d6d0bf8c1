#include <curveskel/read_rig.hpp>

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rig/gltf/read_vrm.hpp"
#include "rig/io/rig_formats.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_pose.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

/// The joints of all skins that move something.
class JointReader {
 public:
  JointReader(const FileBytes& file, const tinygltf::Model& model, const GltfScene& scene)
      : file_(file), model_(model), scene_(scene) {
    for (const GltfSkinned& part : scene.skinned) {
      if (!joints_of_skin_.contains(part.skin)) add_skin(part.skin);
    }
    sort();
  }

  /// Joint of the rig for each joint of the skin.
  [[nodiscard]] const std::vector<int>& joints_of(int skin) const {
    return joints_of_skin_.at(skin);
  }

  /// Of each joint.
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }

  void write(Rig& rig) const {
    const auto count = static_cast<Eigen::Index>(nodes_.size());
    rig.joints.resize(count, 3);
    rig.parents.resize(count);
    rig.names.clear();
    for (Eigen::Index joint = 0; joint < count; ++joint) {
      const int node = nodes_[static_cast<std::size_t>(joint)];
      rig.joints.row(joint) = rest_.at(node).transpose();
      const int above = joint_above_.at(node);
      rig.parents[joint] = above < 0 ? -1 : joint_of_node_.at(above);
      rig.names.push_back(model_.nodes[static_cast<std::size_t>(node)].name);
    }
    name_nameless(rig.names);
    const std::map<int, std::string> roles = vrm_roles(model_);
    if (roles.empty()) return;
    rig.roles.resize(nodes_.size());
    for (std::size_t joint = 0; joint < nodes_.size(); ++joint) {
      const auto role = roles.find(nodes_[joint]);
      if (role != roles.end()) rig.roles[joint] = role->second;
    }
  }

 private:
  void add_skin(int index) {
    const tinygltf::Skin& skin = gltf_element(file_, model_.skins, index, "skin");
    for (const int node : skin.joints) {
      if (rest_.contains(node)) continue;
      nodes_.push_back(node);
      rest_[node] = scene_.frames[static_cast<std::size_t>(node)].translation();
    }
    joints_of_skin_[index] = skin.joints;  // nodes, until `sort`
  }

  /// Parents first: in the order of the scene, then joints that are not in it.
  void sort() {
    for (const int node : scene_.nodes) {
      const int parent = scene_.parents[static_cast<std::size_t>(node)];
      const bool is_joint = parent < 0 || rest_.contains(parent);
      joint_above_[node] = is_joint ? parent : joint_above_.at(parent);
    }
    std::vector<int> sorted;
    for (const int node : scene_.nodes) {
      if (rest_.contains(node)) sorted.push_back(node);
    }
    for (const int node : nodes_) {
      if (joint_above_.try_emplace(node, -1).second) sorted.push_back(node);
    }
    nodes_ = std::move(sorted);
    for (std::size_t joint = 0; joint < nodes_.size(); ++joint) {
      joint_of_node_[nodes_[joint]] = static_cast<int>(joint);
    }
    for (auto& [skin, joints] : joints_of_skin_) {
      for (int& joint : joints) joint = joint_of_node_.at(joint);
    }
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const GltfScene& scene_;
  std::vector<int> nodes_;               // of each joint
  std::map<int, Eigen::Vector3d> rest_;  // by node
  std::map<int, int> joint_above_;       // by node: the nearest node above that is a joint, or -1
  std::map<int, int> joint_of_node_;
  std::map<int, std::vector<int>> joints_of_skin_;
};

/// The weights of one primitive, as triplets with the rig's joints.
class WeightReader {
 public:
  WeightReader(const FileBytes& file, const tinygltf::Model& model) : file_(file), model_(model) {}

  void add(const GltfSkinned& part, const std::vector<int>& joints) {
    for_each_weight(file_, model_, *part.primitive, joints.size(),
                    [&](std::size_t vertex, std::size_t joint, double weight) {
                      if (weight == 0) return;
                      entries_.emplace_back(
                          static_cast<int>(part.first_vertex + static_cast<std::int64_t>(vertex)),
                          joints[joint], static_cast<float>(weight));
                    });
  }

  [[nodiscard]] SkinWeights weights(Eigen::Index vertices, Eigen::Index joints) const {
    SkinWeights result(vertices, joints);
    result.setFromTriplets(entries_.begin(), entries_.end());  // adds entries that are named twice
    for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
      float sum = 0;
      for (SkinWeights::InnerIterator it(result, vertex); it; ++it) sum += it.value();
      if (!(sum > 0)) continue;
      for (SkinWeights::InnerIterator it(result, vertex); it; ++it) it.valueRef() /= sum;
    }
    return result;
  }

 private:
  const FileBytes& file_;
  const tinygltf::Model& model_;
  std::vector<Eigen::Triplet<float>> entries_;
};

}  // namespace

std::optional<Rig> read_rig(const std::filesystem::path& path, const Monitor& monitor) {
  return read_gltf_rig(read_file(path, monitor), monitor);
}

std::optional<Rig> read_gltf_rig(const FileBytes& file, const Monitor& monitor) {
  if (!looks_like_glb(file) && !looks_like_gltf(file)) return std::nullopt;
  const tinygltf::Model model = parse_gltf(file, monitor);
  const GltfScene scene = read_gltf_scene(file, model, monitor);
  if (scene.skinned.empty()) return std::nullopt;
  return rig_of_scene(file, model, scene).rig;
}

GltfRig rig_of_scene(const FileBytes& file, const tinygltf::Model& model, const GltfScene& scene) {
  const JointReader joints(file, model, scene);
  GltfRig found{{}, joints.nodes()};
  joints.write(found.rig);
  WeightReader weights(file, model);
  for (const GltfSkinned& part : scene.skinned) weights.add(part, joints.joints_of(part.skin));
  found.rig.weights = weights.weights(scene.soup.positions.rows(), found.rig.joints.rows());
  return found;
}

}  // namespace curveskel
