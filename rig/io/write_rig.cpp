#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/rig_files.hpp>
#include "base/indices.hpp"
#include "rig/joints/bone_axes.hpp"
#include "surface/mesh/single_precision.hpp"

namespace curveskel {
namespace {

using Json = nlohmann::ordered_json;

// glTF 2.0, section 3.6.2.2 and 3.6.2.3.
constexpr int component_uint8 = 5121;
constexpr int component_uint16 = 5123;
constexpr int component_uint32 = 5125;
constexpr int component_float = 5126;
constexpr int first_joint_node = 2;
constexpr int target_vertices = 34962;
constexpr int target_triangles = 34963;

std::string base64_of(const std::string& bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t given = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      three = three << 8 | (b < given ? static_cast<std::uint8_t>(bytes[k + b]) : 0);
    }
    for (std::size_t letter = 0; letter < 4; ++letter) {
      text += letter <= given ? letters[three >> (18 - 6 * letter) & 63] : '=';
    }
  }
  return text;
}

/// Names of files need not be UTF-8, but JSON is.
std::string text_of(const Json& file, int indent) {
  return file.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// A glTF file that grows accessor by accessor.
class GltfWriter {
 public:
  Json file;

  template <typename Value>
  static void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// In single precision, as glTF has no other.
  static void put_point(std::string& bytes, const Eigen::RowVector3d& point) {
    for (const double coordinate : point) put(bytes, static_cast<float>(coordinate));
  }

  /// The rows as a buffer view with an accessor of its own; returns the accessor.
  int add(const std::string& rows, int component, const char* shape, std::size_t count,
          int target = 0) {
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", rows.size()}};
    if (target != 0) view["target"] = target;
    file["bufferViews"].push_back(view);
    file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"count", count},
                                 {"type", shape}});
    buffer_ += rows;
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    return static_cast<int>(file["accessors"].size()) - 1;
  }

  [[nodiscard]] std::string text() {
    file["buffers"] = {{{"byteLength", buffer_.size()},
                        {"uri", "data:application/octet-stream;base64," + base64_of(buffer_)}}};
    return text_of(file, 1) + "\n";
  }

  /// Section 4.4: header, JSON, numbers; each chunk padded to four bytes.
  [[nodiscard]] std::string binary() {
    file["buffers"] = {{{"byteLength", buffer_.size()}}};
    std::string json = text_of(file, -1);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr std::uint32_t magic = 0x46546C67;
    constexpr std::uint32_t json_chunk = 0x4E4F534A;
    constexpr std::uint32_t binary_chunk = 0x004E4942;
    const std::size_t size = 12 + 8 + json.size() + 8 + buffer_.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(Fault::output, std::to_string(size) +
                                     " bytes, more than the 4 GB that a .glb can have; decimate "
                                     "the surface");
    }
    std::string bytes;
    bytes.reserve(size);
    put(bytes, magic);
    put(bytes, std::uint32_t{2});
    put(bytes, static_cast<std::uint32_t>(size));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    put(bytes, json_chunk);
    bytes += json;
    put(bytes, static_cast<std::uint32_t>(buffer_.size()));
    put(bytes, binary_chunk);
    return bytes + buffer_;
  }

 private:
  std::string buffer_;
};

Json numbers_of(const Eigen::RowVector3d& point) { return {point[0], point[1], point[2]}; }

int add_positions(GltfWriter& writer, const Positions& positions) {
  std::string rows;
  for (const auto& point : positions.rowwise()) GltfWriter::put_point(rows, point);
  const int accessor =
      writer.add(rows, component_float, "VEC3", idx(positions.rows()), target_vertices);
  // The bounds must be those of the numbers in the file.
  const Eigen::RowVector3f least = positions.cast<float>().colwise().minCoeff();
  const Eigen::RowVector3f most = positions.cast<float>().colwise().maxCoeff();
  writer.file["accessors"].back()["min"] = {least[0], least[1], least[2]};
  writer.file["accessors"].back()["max"] = {most[0], most[1], most[2]};
  return accessor;
}

/// Vertices in one place share a normal, or seams would be seen as creases.
Positions normals_across_seams(const Surface& surface) {
  Positions normals = vertex_normals(surface);
  const auto place = [&](int vertex) {
    const auto point = surface.positions.row(vertex);
    return std::tuple(point.x(), point.y(), point.z());
  };
  std::vector<int> order(idx(normals.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (end = first; end < order.size() && place(order[end]) == place(order[first]); ++end) {
      sum += normals.row(order[end]);
    }
    if (end - first == 1 || sum.norm() < 0.1) continue;  // two sides of a sheet keep theirs
    for (std::size_t k = first; k < end; ++k) normals.row(order[k]) = sum.normalized();
  }
  return normals;
}

int add_normals(GltfWriter& writer, const Surface& surface) {
  const Positions normals = normals_across_seams(surface);
  std::string rows;
  for (const auto& normal : normals.rowwise()) {
    const bool usable = normal.allFinite() && normal.squaredNorm() > 0.5;
    GltfWriter::put_point(rows, usable ? Eigen::RowVector3d(normal) : Eigen::RowVector3d(0, 0, 1));
  }
  return writer.add(rows, component_float, "VEC3", idx(normals.rows()), target_vertices);
}

/// JOINTS_0 and WEIGHTS_0: the four largest of each row, which sum to 1 in single precision.
void add_weights(GltfWriter& writer, const SkinWeights& weights, Json& attributes) {
  constexpr std::size_t most = 4;
  const bool small = weights.cols() <= 256;
  std::string which;
  std::string shares;
  for (Eigen::Index vertex = 0; vertex < weights.rows(); ++vertex) {
    std::vector<std::pair<float, int>> row;
    for (SkinWeights::InnerIterator it(weights, vertex); it; ++it) {
      row.emplace_back(it.value(), static_cast<int>(it.col()));
    }
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    row.resize(most, {0.0F, 0});
    float sum = 0;
    for (const auto& [share, joint] : row) sum += share;
    for (const auto& [share, joint] : row) {
      GltfWriter::put(shares, sum > 0 ? share / sum : 0);
      if (small) {
        GltfWriter::put(which, static_cast<std::uint8_t>(joint));
      } else {
        GltfWriter::put(which, static_cast<std::uint16_t>(joint));
      }
    }
  }
  attributes["JOINTS_0"] = writer.add(which, small ? component_uint8 : component_uint16, "VEC4",
                                      idx(weights.rows()), target_vertices);
  attributes["WEIGHTS_0"] =
      writer.add(shares, component_float, "VEC4", idx(weights.rows()), target_vertices);
}

void add_mesh(GltfWriter& writer, const Surface& surface, const Rig& rig, const std::string& name) {
  Json attributes;
  attributes["POSITION"] = add_positions(writer, surface.positions);
  attributes["NORMAL"] = add_normals(writer, surface);
  add_weights(writer, rig.weights, attributes);
  std::string corners;
  for (const auto& triangle : surface.triangles.rowwise()) {
    for (const int vertex : triangle) GltfWriter::put(corners, static_cast<std::uint32_t>(vertex));
  }
  const int indices = writer.add(corners, component_uint32, "SCALAR", idx(surface.triangles.size()),
                                 target_triangles);
  writer.file["meshes"] = {
      {{"name", name}, {"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
}

Json numbers_of(const Eigen::Quaterniond& rotation) {
  return {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
}

/// Node 0 is the parent of all joints, node 1 the mesh, node 2 + k joint k.
Json nodes_of(const Rig& rig, const std::vector<Eigen::Quaterniond>& axes,
              const std::string& name) {
  Json nodes;
  nodes.push_back({{"name", name + " rig"}, {"children", Json::array()}});
  nodes.push_back({{"name", name}, {"mesh", 0}, {"skin", 0}});
  for (Eigen::Index joint = 0; joint < rig.parents.size(); ++joint) {
    const int parent = rig.parents[joint];
    Eigen::Vector3d offset = rig.joints.row(joint).transpose();
    Eigen::Quaterniond turn = axes[idx(joint)];
    if (parent >= 0) {
      const Eigen::Quaterniond back = axes[idx(parent)].conjugate();
      offset = back * (offset - rig.joints.row(parent).transpose());
      turn = (back * turn).normalized();
    }
    nodes.push_back({{"name", rig.names[idx(joint)]},
                     {"translation", numbers_of(Eigen::RowVector3d(offset.transpose()))},
                     {"rotation", numbers_of(turn)}});
    Json& above = nodes[parent < 0 ? 0 : idx(parent + first_joint_node)];
    above["children"].push_back(joint + first_joint_node);
  }
  return nodes;
}

void add_skin(GltfWriter& writer, const Rig& rig, const std::vector<Eigen::Quaterniond>& axes) {
  Json listed = Json::array();
  std::string matrices;
  for (Eigen::Index joint = 0; joint < rig.parents.size(); ++joint) {
    listed.push_back(joint + first_joint_node);
    const Eigen::Matrix3d back = axes[idx(joint)].conjugate().toRotationMatrix();
    for (int column = 0; column < 3; ++column) {
      GltfWriter::put_point(matrices, back.col(column).transpose());
      GltfWriter::put(matrices, 0.0F);
    }
    GltfWriter::put_point(matrices, -(back * rig.joints.row(joint).transpose()).transpose());
    GltfWriter::put(matrices, 1.0F);
  }
  const int bind = writer.add(matrices, component_float, "MAT4", idx(rig.joints.rows()));
  writer.file["skins"] = {{{"inverseBindMatrices", bind}, {"skeleton", 0}, {"joints", listed}}};
}

}  // namespace

std::string format_rig(const Surface& surface, const Rig& rig, RigFormat format,
                       const std::string& name, const std::string& provenance) {
  constexpr Eigen::Index most_joints = 65536;
  if (rig.joints.rows() > most_joints) {
    throw Error(Fault::output, std::to_string(rig.joints.rows()) + " joints, needed at most " +
                                   std::to_string(most_joints) +
                                   "; choose fewer components or longer bones");
  }
  require_single_precision(surface.positions, "glTF");
  require_single_range(rig.joints, "glTF");
  GltfWriter writer;
  writer.file["asset"] = {{"version", "2.0"}, {"generator", provenance}};
  writer.file["scene"] = 0;
  writer.file["scenes"] = {{{"nodes", {0, 1}}}};
  add_mesh(writer, surface, rig, name);
  const std::vector<Eigen::Quaterniond> axes = bone_axes(rig);
  writer.file["nodes"] = nodes_of(rig, axes, name);
  add_skin(writer, rig, axes);
  return format == RigFormat::glb ? writer.binary() : writer.text();
}

}  // namespace curveskel
