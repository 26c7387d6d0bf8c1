#include "rig/gltf/hanging_parts.hpp"

#include <cstddef>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/utf8.hpp"
#include "rig/animations/node_move.hpp"
#include "rig/dae/dae_joints.hpp"
#include "rig/fbx/fbx_joints.hpp"
#include "surface/read/dae_scene.hpp"
#include "surface/read/formats.hpp"

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

/// In the file's coordinates, as shown.
struct HangingPlace {
  std::string name;
  int joint;
  Eigen::Affine3d frame;
};

std::vector<HangingPlace> places_in_fbx(const FileBytes& file) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  const std::vector<FbxJoint> joints = fbx_joints(scene);
  std::vector<HangingPlace> places;
  for (const FbxRecord* model : scene.all("Model")) {
    const bool is_place = !is_fbx_joint(*model) && scene.below(*model, "Geometry").empty();
    const int joint = is_place ? fbx_joint_above(scene, joints, *model) : -1;
    if (joint >= 0) places.push_back({fbx_name(*model), joint, scene.frame(*model)});
  }
  return places;
}

bool shows_a_mesh(const XmlElement& node) {
  return node.child("instance_geometry") != nullptr || node.child("instance_controller") != nullptr;
}

std::vector<HangingPlace> places_in_dae(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_dae(file);
  const DaeDocument document(file, root);
  const std::vector<DaeNode> nodes = dae_nodes(document, monitor);
  const std::vector<int> joint_of_node = dae_joint_of_node(nodes);
  std::vector<HangingPlace> places;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const XmlElement& element = *nodes[k].element;
    if (joint_of_node[k] < 0 || is_dae_joint(nodes[k]) || shows_a_mesh(element)) continue;
    const std::string_view id = element.attribute("id");
    places.push_back(
        {std::string(element.attribute("name", id)), joint_of_node[k], nodes[k].frame});
  }
  return places;
}

}  // namespace

void add_hanging_places(GltfDocument& document, const FileBytes& file, const GltfJoints& joints,
                        const Monitor& monitor) {
  const auto format = surface_format_of(file);
  std::vector<HangingPlace> places;
  if (format == SurfaceFormat::fbx) places = places_in_fbx(file);
  if (format == SurfaceFormat::dae) places = places_in_dae(file, monitor);
  const JointFrames bound = bound_frames(joints.rig);
  OrderedJson& nodes = document.json["nodes"];
  for (const HangingPlace& place : places) {
    const NodeMove move =
        node_move(bound[idx(place.joint)].inverse() * joints.to_gltf * place.frame);
    const auto numbers = [](const auto& row) {
      return std::vector<double>(row.begin(), row.end());
    };
    array_in(nodes[joints.first + idx(place.joint)], "children").push_back(nodes.size());
    nodes.push_back({{"name", as_utf8(place.name)},
                     {"translation", numbers(move.shift)},
                     {"rotation", numbers(move.turn.coeffs())},
                     {"scale", numbers(move.scale)}});
  }
}

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
