#include "rig/gltf/add_gltf_rig.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/free_name.hpp"
#include "base/utf8.hpp"
#include "rig/gltf/number_bytes.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/joints/bone_axes.hpp"

namespace curveskel {
namespace {

bool is_identity(const Eigen::Affine3d& place) {
  return place.matrix() == Eigen::Matrix4d::Identity();
}

std::string free_among(const OrderedJson& nodes, const std::string& name) {
  std::set<std::string> taken;
  for (const OrderedJson& node : nodes) taken.insert(node.value("name", ""));
  return free_name(taken, name, " ");
}

/// In the scene, at its origin.
std::size_t add_holder(OrderedJson& file, const std::string& name) {
  OrderedJson& nodes = array_in(file, "nodes");
  const std::size_t holder = nodes.size();
  nodes.push_back({{"name", free_among(nodes, as_utf8(name))}});
  if (file.contains("scenes")) {
    OrderedJson& scene = file["scenes"].at(file.value("scene", std::size_t{0}));
    array_in(scene, "nodes").push_back(holder);
  }
  return holder;
}

/// Returns the first of them; the others follow.
std::size_t add_joint_nodes(OrderedJson& nodes, const Rig& rig,
                            const std::vector<Eigen::Quaterniond>& axes, std::size_t holder) {
  const std::size_t first = nodes.size();
  const std::vector<LocalFrame> frames = local_frames(rig, axes);
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    const Eigen::Vector3d& at = frames[idx(joint)].offset;
    const Eigen::Quaterniond& turn = frames[idx(joint)].turn;
    nodes.push_back({{"name", as_utf8(rig.names[idx(joint)])},
                     {"translation", {at.x(), at.y(), at.z()}},
                     {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}}});
    const int parent = rig.parents[joint];
    OrderedJson& above = nodes[parent < 0 ? holder : first + idx(parent)];
    array_in(above, "children").push_back(nodes.size() - 1);
  }
  return first;
}

std::size_t add_skin(GltfDocument& document, const Rig& rig,
                     const std::vector<Eigen::Quaterniond>& axes, const Eigen::Affine3d& move,
                     std::size_t first, std::size_t holder) {
  const auto count = idx(rig.parents.size());
  OrderedJson joints = OrderedJson::array();
  for (std::size_t joint = 0; joint < count; ++joint) joints.push_back(first + joint);
  const std::size_t matrices =
      add_accessor(document, inverse_bind_matrices(rig, axes, move), "MAT4", gltf_float, count);
  OrderedJson& skins = array_in(document.json, "skins");
  skins.push_back(
      {{"inverseBindMatrices", matrices}, {"joints", std::move(joints)}, {"skeleton", holder}});
  return skins.size() - 1;
}

}  // namespace

void add_missing_nodes(GltfDocument& document) {
  OrderedJson& file = document.json;
  if (file.contains("nodes") && !file["nodes"].empty()) return;
  OrderedJson all = OrderedJson::array();
  for (std::size_t mesh = 0; mesh < array_in(file, "meshes").size(); ++mesh) {
    array_in(file, "nodes").push_back({{"mesh", mesh}});
    all.push_back(mesh);
  }
  OrderedJson& scenes = array_in(file, "scenes");
  if (scenes.empty()) scenes.push_back(OrderedJson::object());
  scenes.at(file.value("scene", std::size_t{0}))["nodes"] = std::move(all);
}

std::size_t add_gltf_rig(GltfDocument& document, const std::vector<GltfPart>& parts, const Rig& rig,
                         const std::string& name, int holder) {
  require_gltf_joints(rig);
  const std::vector<Eigen::Quaterniond> axes = bone_axes(rig);
  const std::size_t above = holder >= 0 ? idx(holder) : add_holder(document.json, name);
  const std::size_t first = add_joint_nodes(document.json["nodes"], rig, axes, above);
  std::map<std::vector<double>, std::size_t> skin_of_move;
  std::map<int, const GltfPart*> first_part;  // by node; rather of the soup
  for (const GltfPart& part : parts) {
    const GltfPart*& known = first_part[part.node];
    if (known == nullptr || (part.in_soup && !known->in_soup)) known = &part;
  }
  const auto skin_for = [&](const Eigen::Affine3d& move) {
    const auto numbers = move.matrix().reshaped();
    const auto [skin, is_new] =
        skin_of_move.try_emplace(std::vector<double>(numbers.begin(), numbers.end()));
    if (is_new) skin->second = add_skin(document, rig, axes, move, first, above);
    return skin->second;
  };
  for (const auto& [node, first_of_node] : first_part) {
    if (!is_identity(first_of_node->move)) (void)skin_for(first_of_node->move);
  }
  // By the last skin Blender tells where joints are at rest; by that of a mesh that is moved or
  // scaled on its way to the scene they would be elsewhere, and maybe too near each other for it.
  (void)skin_for(Eigen::Affine3d::Identity());
  for (const auto& [node, first_of_node] : first_part) {
    document.json["nodes"][idx(node)]["skin"] = skin_for(first_of_node->move);
  }
  return first;
}

}  // namespace curveskel
