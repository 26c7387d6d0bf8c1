#include "rig/gltf/add_gltf_rig.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/number_bytes.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/joints/bone_axes.hpp"

namespace curveskel {
namespace {

double scale_of(const Eigen::Affine3d& place) {
  return std::cbrt(std::max(place.linear().determinant(), 0.0));
}

bool is_similarity(const Eigen::Affine3d& place) {
  constexpr double rounding = 1e-5;
  const double scale = scale_of(place);
  const Eigen::Matrix3d gram = place.linear().transpose() * place.linear();
  return scale > 0 && (gram / (scale * scale) - Eigen::Matrix3d::Identity()).norm() < rounding;
}

/// What takes most vertices to the scene, if joints can be placed by it: Blender takes joints for
/// at rest only where they are so in the frame of the mesh.
Eigen::Affine3d place_of_joints(const std::vector<GltfPart>& parts) {
  const GltfPart* largest = nullptr;
  for (const GltfPart& part : parts) {
    if (part.in_soup && (largest == nullptr || part.count > largest->count)) largest = &part;
  }
  return largest != nullptr && is_similarity(largest->move) ? largest->move
                                                            : Eigen::Affine3d::Identity();
}

/// The rig and its axes in the frame of `place`.
Rig rig_within(const Rig& rig, const Eigen::Affine3d& place) {
  Rig inside{rig.joints, rig.parents, rig.names, {}, {}, rig.turns};
  const Eigen::Affine3d back = place.inverse();
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    inside.joints.row(joint) = (back * rig.joints.row(joint).transpose()).transpose();
  }
  const Eigen::Quaterniond turn(Eigen::Matrix3d(place.linear() / scale_of(place)));
  for (Eigen::Quaterniond& rests : inside.turns) rests = turn.conjugate() * rests * turn;
  return inside;
}

std::string free_name(const OrderedJson& nodes, const std::string& name) {
  std::set<std::string> taken;
  for (const OrderedJson& node : nodes) taken.insert(node.value("name", ""));
  std::string free = name;
  for (int k = 2; taken.contains(free); ++k) free = name + " " + std::to_string(k);
  return free;
}

/// In the scene, placed there by a similarity.
std::size_t add_holder(OrderedJson& file, const std::string& name, const Eigen::Affine3d& place) {
  OrderedJson& nodes = array_in(file, "nodes");
  const std::size_t holder = nodes.size();
  OrderedJson node = {{"name", free_name(nodes, as_utf8(name))}};
  if (!place.isApprox(Eigen::Affine3d::Identity(), 0)) {
    const double scale = scale_of(place);
    const Eigen::Vector3d at = place.translation();
    const Eigen::Quaterniond turn(Eigen::Matrix3d(place.linear() / scale));
    node["translation"] = {at.x(), at.y(), at.z()};
    node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
    node["scale"] = {scale, scale, scale};
  }
  nodes.push_back(std::move(node));
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

void add_gltf_rig(GltfDocument& document, const std::vector<GltfPart>& parts, const Rig& rig,
                  const std::string& name, int holder) {
  require_gltf_joints(rig);
  const Eigen::Affine3d place = place_of_joints(parts);
  const bool is_moved = !place.isApprox(Eigen::Affine3d::Identity(), 0);
  const Rig inside = is_moved ? rig_within(rig, place) : rig;
  std::vector<Eigen::Quaterniond> axes = bone_axes(rig);
  if (is_moved) {
    const Eigen::Quaterniond turn(Eigen::Matrix3d(place.linear() / scale_of(place)));
    for (Eigen::Quaterniond& axis : axes) axis = (turn.conjugate() * axis).normalized();
  }
  const std::size_t above =
      holder >= 0 && !is_moved ? idx(holder) : add_holder(document.json, name, place);
  const std::size_t first = add_joint_nodes(document.json["nodes"], inside, axes, above);
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
    if (is_new) {
      const Eigen::Affine3d within = is_moved ? place.inverse() * move : move;
      skin->second = add_skin(document, inside, axes, within, first, above);
    }
    return skin->second;
  };
  if (is_moved) (void)skin_for(place);  // the first, which Blender looks at
  for (const auto& [node, first_of_node] : first_part) {
    document.json["nodes"][idx(node)]["skin"] = skin_for(first_of_node->move);
  }
}

}  // namespace curveskel
