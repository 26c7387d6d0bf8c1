// A bar of cubes along x with joints at x = 0, 1, 2, ...: a rig of which everything is known.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include "tests/surface/encodings.hpp"

namespace curveskel {

/// The ways in which a file may say the same rig.
struct RiggedBar {
  int joints = 4;
  bool children_first = false;    ///< in the skin's list of joints
  bool helper_nodes = false;      ///< a node that is no joint between each joint and its parent
  bool inverse_bind = true;       ///< else the scene alone says where joints are
  bool normalized_bytes = false;  ///< weights as bytes instead of floats
  double unit = 1;                ///< all weights are multiplied by it
  double first_weight = 1;        ///< of vertex 0, before the unit
  int first_joint = -1;           ///< of vertex 0, in the skin; -1 = its own
  double matrix_scale = 1;        ///< of the inverse bind matrices; 0 = not affine
  double turn = 0;                ///< of each joint against the one before, beside its bind pose
};

namespace rigged_bar {

template <typename Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Adds the bytes as a buffer view with an accessor of its own and returns the accessor.
inline int add_rows(nlohmann::json& file, std::string& buffer, const std::string& bytes, int type,
                    const char* shape, std::size_t rows, bool normalized = false) {
  file["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
  file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                               {"componentType", type},
                               {"count", rows},
                               {"type", shape},
                               {"normalized", normalized}});
  buffer += bytes;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  return static_cast<int>(file["accessors"].size()) - 1;
}

}  // namespace rigged_bar

/// The bind frame of joint k: on the x axis, turned a little more than the joint before.
inline Eigen::Affine3d bind_of_joint(int joint) {
  Eigen::Affine3d bind = Eigen::Affine3d::Identity();
  bind.translate(Eigen::Vector3d(joint, 0, 0));
  bind.rotate(Eigen::AngleAxisd(0.3 * joint, Eigen::Vector3d::UnitZ()));
  return bind;
}

/// Text of a glTF file. Ring k of the bar (4 vertices at x = k - 0.5, the last at joints - 0.5) is
/// moved by joint k - 1 and joint k in equal parts; the ends by one joint alone. The file shows the
/// bar so where `turn` is 0. `numbers` gets the bytes of the buffer.
inline std::string gltf_of(const RiggedBar& bar, std::string* numbers = nullptr) {
  using rigged_bar::add_rows;
  using rigged_bar::append;
  const int rings = bar.joints + 1;
  std::string positions;
  std::string which;
  std::string shares;
  std::string indices;
  const auto add_share = [&](double share) {
    share *= bar.unit;
    if (bar.normalized_bytes) {
      append(shares, static_cast<std::uint8_t>(std::lround(255 * share)));
    } else {
      append(shares, static_cast<float>(share));
    }
  };
  const auto row_of_skin = [&](int joint) {
    return bar.children_first ? bar.joints - 1 - joint : joint;
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int corner = 0; corner < 4; ++corner) {
      const int before = std::max(ring - 1, 0);
      const int after = std::min(ring, bar.joints - 1);
      Eigen::Affine3d blend = Eigen::Affine3d::Identity();  // of joints without matrices
      if (!bar.inverse_bind) {
        blend.matrix() = (bind_of_joint(before).matrix() + bind_of_joint(after).matrix()) / 2;
      }
      const Eigen::Vector3d point(ring - 0.5, corner == 1 || corner == 2 ? 0.5 : -0.5,
                                  corner >= 2 ? 0.5 : -0.5);
      for (const double x : Eigen::Vector3d(blend.inverse() * point)) {
        append(positions, static_cast<float>(x));
      }
      const bool first = ring == 0 && corner == 0;
      append(which, static_cast<std::uint8_t>(first && bar.first_joint >= 0 ? bar.first_joint
                                                                            : row_of_skin(before)));
      append(which, static_cast<std::uint8_t>(row_of_skin(after)));
      append(which, std::uint16_t{0});
      add_share(first ? bar.first_weight : before == after ? 1 : 0.5);
      add_share(before == after ? 0 : 0.5);
      add_share(0);
      add_share(0);
    }
  }
  const auto add_quad = [&](int a, int b, int c, int d) {
    for (const int v : {a, b, c, a, c, d}) append(indices, static_cast<std::uint16_t>(v));
  };
  add_quad(0, 3, 2, 1);
  for (int ring = 0; ring + 1 < rings; ++ring) {
    for (int side = 0; side < 4; ++side) {
      const int next = (side + 1) % 4;
      add_quad(4 * ring + side, 4 * ring + next, 4 * ring + 4 + next, 4 * ring + 4 + side);
    }
  }
  const int end = 4 * (rings - 1);
  add_quad(end, end + 1, end + 2, end + 3);

  nlohmann::json file{{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  std::string buffer;
  const auto vertices = 4 * static_cast<std::size_t>(rings);
  const nlohmann::json attributes{
      {"POSITION", add_rows(file, buffer, positions, 5126, "VEC3", vertices)},
      {"JOINTS_0", add_rows(file, buffer, which, 5121, "VEC4", vertices)},
      {"WEIGHTS_0", add_rows(file, buffer, shares, bar.normalized_bytes ? 5121 : 5126, "VEC4",
                             vertices, bar.normalized_bytes)}};
  const int corners = add_rows(file, buffer, indices, 5123, "SCALAR", indices.size() / 2);
  file["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", corners}}}}}};
  file["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"name", "bar"}, {"translation", {9, 9, 9}}}};
  nlohmann::json roots{0};
  std::vector<int> node_of_joint;
  int parent = -1;
  const auto add_node = [&](const std::string& name, const Eigen::Affine3d& frame) {
    const Eigen::Vector3d at = frame.translation();
    const Eigen::Quaterniond turn(frame.rotation());
    file["nodes"].push_back({{"name", name},
                             {"translation", {at.x(), at.y(), at.z()}},
                             {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}}});
    const int node = static_cast<int>(file["nodes"].size()) - 1;
    if (parent < 0) {
      roots.push_back(node);
    } else {
      file["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(node);
    }
    parent = node;
    return node;
  };
  for (int joint = 0; joint < bar.joints; ++joint) {
    Eigen::Affine3d step = bind_of_joint(joint);
    if (joint > 0) step = bind_of_joint(joint - 1).inverse() * step;
    step.rotate(Eigen::AngleAxisd(bar.turn, Eigen::Vector3d(1, 2, 2) / 3));
    if (bar.helper_nodes) {
      const Eigen::Translation3d helper(joint == 0 ? Eigen::Vector3d(-3, 0, 0)
                                                   : Eigen::Vector3d(step.translation() / 4));
      add_node("helper", Eigen::Affine3d(helper));
      step = helper.inverse() * step;
    }
    node_of_joint.push_back(add_node("joint " + std::to_string(joint), step));
  }
  file["scenes"] = {{{"nodes", roots}}};
  nlohmann::json listed = nlohmann::json::array();
  std::string matrices;
  for (int row = 0; row < bar.joints; ++row) {
    const int joint = row_of_skin(row);
    listed.push_back(node_of_joint[static_cast<std::size_t>(joint)]);
    const Eigen::Matrix4f inverse =
        (bind_of_joint(joint).inverse().matrix() * bar.matrix_scale).cast<float>();
    for (Eigen::Index k = 0; k < 16; ++k) append(matrices, inverse(k));
  }
  file["skins"] = {{{"joints", listed}}};
  if (bar.inverse_bind) {
    file["skins"][0]["inverseBindMatrices"] =
        add_rows(file, buffer, matrices, 5126, "MAT4", static_cast<std::size_t>(bar.joints));
  }
  file["buffers"] = {
      {{"byteLength", buffer.size()},
       {"uri", "data:application/octet-stream;base64," + encodings::base64(buffer)}}};
  if (numbers != nullptr) *numbers = buffer;
  return file.dump();
}

inline void write_rigged_bar(const std::filesystem::path& path, const RiggedBar& bar) {
  write_file(path, gltf_of(bar));
}

}  // namespace curveskel
