#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/rig_files.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/seam_normals.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/io/rig_writers.hpp"
#include "rig/joints/bone_axes.hpp"
#include "surface/mesh/single_precision.hpp"

namespace curveskel {
namespace {

constexpr int first_joint_node = 2;

/// A glTF model that grows accessor by accessor, all in one buffer.
class GltfWriter {
 public:
  GltfWriter() { model.buffers.emplace_back(); }

  tinygltf::Model model;

  template <typename Value>
  static void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// In single precision, as glTF has no other.
  static void put_point(std::string& bytes, const Eigen::RowVector3d& point) {
    for (const double coordinate : point) put(bytes, static_cast<float>(coordinate));
  }

  /// The rows as a buffer view with an accessor of its own; returns the accessor.
  int add(const std::string& rows, int component, int shape, std::size_t count, int target = 0) {
    std::vector<unsigned char>& buffer = model.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = rows.size();
    view.target = target;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size());
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = shape;
    model.bufferViews.push_back(std::move(view));
    model.accessors.push_back(std::move(accessor));
    buffer.insert(buffer.end(), rows.begin(), rows.end());
    buffer.resize((buffer.size() + 3) / 4 * 4);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  /// As a binary file, or as text with the buffer in it. tinygltf counts bytes in 32 bits.
  [[nodiscard]] std::string bytes(RigFormat format) const {
    const bool binary = format == RigFormat::glb;
    require_four_gigabytes(model.buffers.front().data.size());
    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, true, binary);
    std::string written = std::move(stream).str();
    if (binary) require_four_gigabytes(written.size());
    return written;
  }

 private:
  static void require_four_gigabytes(std::size_t size) {
    if (size <= std::numeric_limits<std::uint32_t>::max()) return;
    throw Error(Fault::output, std::to_string(size) +
                                   " bytes, more than the 4 GB that a glTF file can have; "
                                   "decimate the surface");
  }
};

std::vector<double> numbers_of(const Eigen::RowVector3d& point) {
  return {point[0], point[1], point[2]};
}

int add_positions(GltfWriter& writer, const Positions& positions) {
  std::string rows;
  for (const auto& point : positions.rowwise()) GltfWriter::put_point(rows, point);
  const int accessor = writer.add(rows, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                  idx(positions.rows()), TINYGLTF_TARGET_ARRAY_BUFFER);
  // The bounds must be those of the numbers in the file.
  const auto single = positions.cast<float>();
  tinygltf::Accessor& written = writer.model.accessors.back();
  written.minValues = numbers_of(single.colwise().minCoeff().cast<double>());
  written.maxValues = numbers_of(single.colwise().maxCoeff().cast<double>());
  return accessor;
}

int add_normals(GltfWriter& writer, const Surface& surface) {
  const Positions normals = normals_across_seams(surface);
  std::string rows;
  for (const auto& normal : normals.rowwise()) GltfWriter::put_point(rows, normal);
  return writer.add(rows, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, idx(normals.rows()),
                    TINYGLTF_TARGET_ARRAY_BUFFER);
}

/// JOINTS_0 and WEIGHTS_0.
void add_weights(GltfWriter& writer, const SkinWeights& weights,
                 std::map<std::string, int>& attributes) {
  const SkinRows rows = skin_rows(weights, 0, weights.rows());
  attributes["JOINTS_0"] =
      writer.add(rows.joints,
                 rows.in_words ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                               : TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                 TINYGLTF_TYPE_VEC4, idx(weights.rows()), TINYGLTF_TARGET_ARRAY_BUFFER);
  attributes["WEIGHTS_0"] =
      writer.add(rows.weights, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4,
                 idx(weights.rows()), TINYGLTF_TARGET_ARRAY_BUFFER);
}

void add_mesh(GltfWriter& writer, const Surface& surface, const Rig& rig, const std::string& name) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = add_positions(writer, surface.positions);
  primitive.attributes["NORMAL"] = add_normals(writer, surface);
  add_weights(writer, rig.weights, primitive.attributes);
  std::string corners;
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (const int vertex : triangle) GltfWriter::put(corners, static_cast<std::uint32_t>(vertex));
  }
  primitive.indices =
      writer.add(corners, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                 idx(surface.triangles.size()), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  tinygltf::Mesh& mesh = writer.model.meshes.emplace_back();
  mesh.name = name;
  mesh.primitives.push_back(std::move(primitive));
}

/// Node 0 is the parent of all joints, node 1 the mesh, node 2 + k joint k.
void add_nodes(GltfWriter& writer, const Rig& rig, const std::vector<Eigen::Quaterniond>& axes,
               const std::string& name) {
  std::vector<tinygltf::Node>& nodes = writer.model.nodes;
  nodes.resize(idx(first_joint_node + rig.parents.size()));
  nodes[0].name = name + " rig";
  nodes[1].name = name;
  nodes[1].mesh = 0;
  nodes[1].skin = 0;
  const std::vector<LocalFrame> frames = local_frames(rig, axes);
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    const int parent = rig.parents[joint];
    const Eigen::Quaterniond& turn = frames[idx(joint)].turn;
    tinygltf::Node& node = nodes[idx(first_joint_node + joint)];
    node.name = as_utf8(rig.names[idx(joint)]);
    node.translation = numbers_of(frames[idx(joint)].offset.transpose());
    node.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
    nodes[parent < 0 ? 0 : idx(first_joint_node + parent)].children.push_back(first_joint_node +
                                                                              joint);
  }
  tinygltf::Scene& scene = writer.model.scenes.emplace_back();
  scene.nodes = {0, 1};
  writer.model.defaultScene = 0;
}

void add_skin(GltfWriter& writer, const Rig& rig, const std::vector<Eigen::Quaterniond>& axes) {
  tinygltf::Skin& skin = writer.model.skins.emplace_back();
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    skin.joints.push_back(first_joint_node + joint);
  }
  const std::string matrices = inverse_bind_matrices(rig, axes, Eigen::Affine3d::Identity());
  skin.inverseBindMatrices = writer.add(matrices, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4,
                                        idx(rig.joints.rows()));
  skin.skeleton = 0;
}

}  // namespace

std::string format_gltf_rig(const Surface& surface, const Rig& rig, RigFormat format,
                            const std::string& name, const std::string& provenance) {
  require_gltf_joints(rig);
  require_single_precision(surface.positions, "glTF");
  GltfWriter writer;
  writer.model.asset.version = "2.0";
  writer.model.asset.generator = as_utf8(provenance);
  const std::string model_name = as_utf8(name);
  add_mesh(writer, surface, rig, model_name);
  const std::vector<Eigen::Quaterniond> axes = bone_axes(rig);
  add_nodes(writer, rig, axes, model_name);
  add_skin(writer, rig, axes);
  return writer.bytes(format);
}

}  // namespace curveskel
