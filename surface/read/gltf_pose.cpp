#include "surface/read/gltf_pose.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "surface/read/formats.hpp"
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

constexpr std::string_view pose_remedy = "export the file again";

Eigen::Vector3d moved(const GltfMove& blend, const Eigen::Vector3d& point) {
  return blend.leftCols<3>() * point + blend.col(3);
}

std::vector<Eigen::Vector3d> modelled_positions(const FileBytes& file, const tinygltf::Model& model,
                                                const tinygltf::Primitive& primitive,
                                                const std::vector<double>& morph_weights,
                                                const Monitor& monitor) {
  const GltfNumbers rows =
      gltf_numbers(file, model, primitive.attributes.at("POSITION"), 3, "positions");
  std::vector<Eigen::Vector3d> points(rows.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % rows_per_report == 0) monitor.report("read", 0.5);
    points[i] = {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
  }
  const std::size_t targets = std::min(primitive.targets.size(), morph_weights.size());
  for (std::size_t target = 0; target < targets; ++target) {
    const auto entry = primitive.targets[target].find("POSITION");
    const double weight = morph_weights[target];
    if (weight == 0 || entry == primitive.targets[target].end()) continue;
    const GltfNumbers shifts = gltf_numbers(file, model, entry->second, 3, "morphed positions");
    if (shifts.rows() != points.size()) {
      file.fail(std::to_string(shifts.rows()) + " rows in morph target " + std::to_string(target),
                "one for each of the " + std::to_string(points.size()) + " vertices", pose_remedy);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += weight * Eigen::Vector3d(shifts.at(i, 0), shifts.at(i, 1), shifts.at(i, 2));
    }
  }
  return points;
}

/// The moves of one primitive's vertices by the joints of its skin.
class Blending {
 public:
  Blending(const FileBytes& file, const tinygltf::Model& model,
           const tinygltf::Primitive& primitive, const GltfSkinPose& skin, std::size_t vertices)
      : skin_(skin),
        blends_(vertices, GltfMove::Zero()),
        sums_(vertices, 0),
        first_joints_(vertices, none),
        has_weights_(skin.joints.size(), false) {
    for_each_weight(file, model, primitive, skin.joints.size(),
                    [&](std::size_t vertex, std::size_t joint, double weight) {
                      if (first_joints_[vertex] == none) first_joints_[vertex] = joint;
                      if (weight == 0) return;
                      blends_[vertex] += weight * skin.joints[joint].matrix().topRows<3>();
                      sums_[vertex] += weight;
                      has_weights_[joint] = true;
                    });
  }

  /// The move of all, where there is one.
  [[nodiscard]] std::optional<Eigen::Affine3d> common(const Eigen::AlignedBox3d& box) const {
    constexpr double alike = 1e-5;  // single precision loses so much over a chain of joints
    const auto first = std::find(has_weights_.begin(), has_weights_.end(), true);
    if (first == has_weights_.end()) return skin_.without_weights;
    const Eigen::Affine3d move =
        skin_.joints[static_cast<std::size_t>(first - has_weights_.begin())];
    const auto corner = [&](int k) {
      return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    };
    const double tolerance = alike * (move.linear() * box.diagonal()).norm();
    const auto differs = [&](const Eigen::Affine3d& other) {
      for (int k = 0; k < 8; ++k) {
        if (!((move * corner(k) - other * corner(k)).norm() <= tolerance)) return true;
      }
      return false;
    };
    for (std::size_t joint = 0; joint < has_weights_.size(); ++joint) {
      if (has_weights_[joint] && differs(skin_.joints[joint])) return std::nullopt;
    }
    return differs(Eigen::Affine3d::Identity()) ? move : Eigen::Affine3d::Identity();
  }

  [[nodiscard]] GltfMove of(std::size_t vertex) const {
    if (sums_[vertex] > 0) return blends_[vertex] / sums_[vertex];
    const std::size_t joint = first_joints_[vertex];
    return (joint == none ? skin_.without_weights : skin_.joints[joint]).matrix().topRows<3>();
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const GltfSkinPose& skin_;
  std::vector<GltfMove> blends_;  // of each vertex, over the sum of its weights
  std::vector<double> sums_;
  std::vector<std::size_t> first_joints_;
  std::vector<bool> has_weights_;  // per joint
};

void move_all(GltfPlaced& placed, const Eigen::Affine3d& move) {
  placed.mirrored = move.linear().determinant() < 0;
  placed.positions = placed.modelled;
  placed.move = move;
  if (move.matrix() == Eigen::Matrix4d::Identity()) return;
  for (Eigen::Vector3d& point : placed.positions) point = move * point;
}

void bend(GltfPlaced& placed, const Blending& blending) {
  const std::size_t count = placed.modelled.size();
  placed.bent = true;
  placed.positions.resize(count);
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const GltfMove blend = blending.of(i);
    if (blend.leftCols<3>().determinant() < 0) ++mirrored;
    placed.positions[i] = moved(blend, placed.modelled[i]);
  }
  placed.mirrored = 2 * mirrored > count;
}

/// The nearest node above the first joint that lies above all joints and is none: Blender's
/// armature. -1: there is none.
int node_above_joints(const std::vector<int>& joints, const std::vector<int>& parents) {
  const auto parent = [&](int node) { return parents[static_cast<std::size_t>(node)]; };
  const auto is_above = [&](int above, int node) {
    while (node >= 0 && node != above) node = parent(node);
    return node == above;
  };
  int above = parent(joints.front());
  const auto is_above_all = [&] {
    return std::none_of(joints.begin(), joints.end(),
                        [&](int joint) { return joint == above || !is_above(above, joint); });
  };
  while (above >= 0 && !is_above_all()) above = parent(above);
  return above;
}

/// Of the joints the first with the fewest nodes above it, by its number in the skin.
std::size_t topmost_joint(const std::vector<int>& joints, const std::vector<int>& parents) {
  const auto depth = [&](int node) {
    int above = 0;
    while ((node = parents[static_cast<std::size_t>(node)]) >= 0) ++above;
    return above;
  };
  const auto is_higher = [&](int a, int b) { return depth(a) < depth(b); };
  return static_cast<std::size_t>(std::min_element(joints.begin(), joints.end(), is_higher) -
                                  joints.begin());
}

}  // namespace

GltfSkinPose skin_pose(const FileBytes& file, const tinygltf::Model& model, int skin,
                       const std::vector<Eigen::Affine3d>& frames,
                       const std::vector<int>& parents) {
  const tinygltf::Skin& joints = gltf_element(file, model.skins, skin, "skin");
  std::optional<GltfNumbers> matrices;
  if (joints.inverseBindMatrices >= 0) {
    matrices = gltf_numbers(file, model, joints.inverseBindMatrices, 16, "inverse bind matrices");
  }
  if (joints.joints.empty() || (matrices && matrices->rows() < joints.joints.size())) {
    file.fail((matrices ? std::to_string(matrices->rows()) : "no") +
                  " inverse bind matrices in skin " + std::to_string(skin),
              "joints, and one for each of its " + std::to_string(joints.joints.size()) + " joints",
              pose_remedy);
  }
  GltfSkinPose pose;
  for (std::size_t i = 0; i < joints.joints.size(); ++i) {
    const int node = joints.joints[i];
    gltf_element(file, model.nodes, node, "joint");
    Eigen::Matrix4d inverse_bind = Eigen::Matrix4d::Identity();
    for (Eigen::Index k = 0; matrices && k < 16; ++k) {
      inverse_bind(k) = matrices->at(i, static_cast<std::size_t>(k));  // both by columns
    }
    if (!inverse_bind.allFinite() ||
        (inverse_bind.row(3) - Eigen::RowVector4d::UnitW()).norm() > 1e-3) {
      file.fail("an inverse bind matrix of joint " + std::to_string(node) + " that is not affine",
                "finite numbers and a last row of 0 0 0 1", pose_remedy);
    }
    pose.joints.push_back(frames[static_cast<std::size_t>(node)] * Eigen::Affine3d(inverse_bind));
  }
  const int above = node_above_joints(joints.joints, parents);
  pose.without_weights =
      above < 0 ? Eigen::Affine3d::Identity() : frames[static_cast<std::size_t>(above)];
  pose.topmost = pose.joints[topmost_joint(joints.joints, parents)];
  return pose;
}

GltfPlaced placed_positions(const FileBytes& file, const tinygltf::Model& model,
                            const tinygltf::Primitive& primitive,
                            const std::vector<double>& morph_weights, const Eigen::Affine3d& frame,
                            const GltfSkinPose* skin, const Monitor& monitor) {
  GltfPlaced placed;
  placed.modelled = modelled_positions(file, model, primitive, morph_weights, monitor);
  if (skin == nullptr) {
    move_all(placed, frame);
    return placed;
  }
  const Blending blending(file, model, primitive, *skin, placed.modelled.size());
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : placed.modelled) box.extend(point);
  if (const auto move = blending.common(box)) {
    move_all(placed, *move);
  } else {
    bend(placed, blending);
  }
  return placed;
}

std::vector<GltfMove> vertex_moves(const FileBytes& file, const tinygltf::Model& model,
                                   const tinygltf::Primitive& primitive, const GltfSkinPose& skin,
                                   std::size_t vertices) {
  const Blending blending(file, model, primitive, skin, vertices);
  std::vector<GltfMove> moves;
  moves.reserve(vertices);
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) moves.push_back(blending.of(vertex));
  return moves;
}

std::vector<int> accessors_of_positions(const tinygltf::Primitive& primitive) {
  std::vector<int> accessors{primitive.attributes.at("POSITION")};
  for (const auto& target : primitive.targets) {
    const auto entry = target.find("POSITION");
    accessors.push_back(entry == target.end() ? -1 : entry->second);
  }
  for (const auto& [name, accessor] : primitive.attributes) {
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) accessors.push_back(accessor);
  }
  return accessors;
}

void for_each_weight(const FileBytes& file, const tinygltf::Model& model,
                     const tinygltf::Primitive& primitive, std::size_t joint_count,
                     const std::function<void(std::size_t, std::size_t, double)>& visit) {
  const auto& attributes = primitive.attributes;
  const std::size_t vertices =
      gltf_numbers(file, model, attributes.at("POSITION"), 3, "positions").rows();
  for (int set = 0;; ++set) {
    const auto joint_entry = attributes.find("JOINTS_" + std::to_string(set));
    const auto weight_entry = attributes.find("WEIGHTS_" + std::to_string(set));
    if (joint_entry == attributes.end() || weight_entry == attributes.end()) return;
    const GltfNumbers which = gltf_numbers(file, model, joint_entry->second, 4, "joints");
    const GltfNumbers share = gltf_numbers(file, model, weight_entry->second, 4, "weights");
    if (which.rows() != vertices || share.rows() != vertices) {
      file.fail(std::to_string(which.rows()) + " rows of joints and " +
                    std::to_string(share.rows()) + " of weights",
                "one for each of the " + std::to_string(vertices) + " vertices", pose_remedy);
    }
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = share.at(vertex, k);
        const double joint = which.at(vertex, k);
        const bool is_joint = joint >= 0 && joint < static_cast<double>(joint_count);
        if (weight == 0 && !is_joint) continue;  // nothing goes wrong by it
        if (!(weight >= 0 && weight < 1e6) || !is_joint) {
          file.fail(
              "weight " + std::to_string(weight) + " of joint " + std::to_string(joint) +
                  " at vertex " + std::to_string(vertex) + " (counted from 0)",
              "weights of at least 0 of the skin's " + std::to_string(joint_count) + " joints",
              pose_remedy);
        }
        visit(vertex, static_cast<std::size_t>(joint), weight);
      }
    }
  }
}

}  // namespace curveskel
