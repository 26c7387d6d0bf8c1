// The places of vertices in a glTF scene by the standard's rule (section 3.7.3.3), written down a
// second time and as plainly as can be: sparse and compressed storage are left out.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace curveskel {

class GltfByTheRule {
 public:
  struct Vertex {
    Eigen::Vector3d modelled;  ///< morphed
    Eigen::Vector3d placed;
    bool is_weighted;  ///< the rule says nothing of a skinned vertex without weights
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< as placed, of length 1; zero: none
    Eigen::Vector4d tangent = Eigen::Vector4d::Zero();  ///< likewise
  };

  /// `weights` of morph targets; empty: each mesh has the file's own.
  explicit GltfByTheRule(const std::filesystem::path& file, std::vector<double> weights = {})
      : weights_(std::move(weights)) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    std::string embedded;
    std::string text = bytes;
    if (bytes.starts_with("glTF")) {
      std::uint32_t length = 0;
      std::memcpy(&length, bytes.data() + 12, 4);
      text = bytes.substr(20, length);
      if (bytes.size() > 28 + length) embedded = bytes.substr(28 + length);
    }
    json_ = nlohmann::json::parse(text);
    for (const auto& buffer : json_["buffers"]) {
      buffers_.push_back(buffer.contains("uri") ? content(buffer["uri"], file) : embedded);
    }
    frames_.resize(json_["nodes"].size(), Eigen::Matrix4d::Identity());
    const auto& scene = json_["scenes"].at(json_.value("scene", std::size_t{0}));
    for (const std::size_t root : scene["nodes"]) walk(root, Eigen::Matrix4d::Identity());
  }

  /// Of each primitive of each shown mesh, in the order of the scene; once for primitives that
  /// share their accessors.
  [[nodiscard]] std::vector<Vertex> vertices() const {
    std::vector<Vertex> all;
    for (const std::size_t index : shown_) {
      const auto& node = json_["nodes"][index];
      if (!node.contains("mesh")) continue;
      const auto& mesh = json_["meshes"].at(node["mesh"].get<std::size_t>());
      std::set<std::string> seen;
      for (const auto& primitive : mesh["primitives"]) {
        if (primitive.value("mode", 4) < 4) continue;
        nlohmann::json key = primitive["attributes"];
        for (const char* other : {"NORMAL", "TANGENT"}) key.erase(other);
        for (int k = 0; k < 8; ++k) {
          key.erase("TEXCOORD_" + std::to_string(k));
          key.erase("COLOR_" + std::to_string(k));
        }
        key["targets"] = primitive.value("targets", nlohmann::json::array());
        if (seen.insert(key.dump()).second) append(all, primitive, mesh, node, frames_[index]);
      }
    }
    return all;
  }

  /// Of each joint, by the name of its node: frame times inverse bind matrix.
  [[nodiscard]] std::map<std::string, Eigen::Matrix4d> moves_of_joints() const {
    std::map<std::string, Eigen::Matrix4d> all;
    for (const auto& skin : json_["skins"]) {
      const auto moves = moves_of(skin);
      for (std::size_t k = 0; k < moves.size(); ++k) {
        all[json_["nodes"].at(skin["joints"][k].get<std::size_t>())["name"]] = moves[k];
      }
    }
    return all;
  }

  [[nodiscard]] bool is_plain() const {
    for (const auto& accessor : json_["accessors"]) {
      if (accessor.contains("sparse") || !accessor.contains("bufferView")) return false;
    }
    return true;
  }

 private:
  static std::string content(const std::string& uri, const std::filesystem::path& file) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) {
      std::ifstream stream(file.parent_path() / uri, std::ios::binary);
      return {std::istreambuf_iterator<char>(stream), {}};
    }
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : uri.substr(comma + 8)) {
      if (c == '=') break;
      bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
      count += 6;
      if (count < 8) continue;
      count -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 255U);
    }
    return bytes;
  }

  template <typename Value>
  static double number(const char* at) {
    Value value{};
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  }

  [[nodiscard]] std::vector<std::vector<double>> rows(std::size_t index) const {
    static const std::map<std::string, std::size_t> widths{
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const auto& accessor = json_["accessors"].at(index);
    const auto& view = json_["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::string& buffer = buffers_.at(view["buffer"].get<std::size_t>());
    const std::size_t width = widths.at(accessor["type"]);
    const int type = accessor["componentType"];
    const std::size_t size = type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
    const std::size_t stride = view.value("byteStride", size * width);
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    std::vector<std::vector<double>> all;
    for (std::size_t row = 0; row < accessor["count"].get<std::size_t>(); ++row) {
      all.emplace_back();
      for (std::size_t k = 0; k < width; ++k) {
        const char* at = buffer.data() + begin + row * stride + k * size;
        double value = type == 5120   ? number<std::int8_t>(at)
                       : type == 5121 ? number<std::uint8_t>(at)
                       : type == 5122 ? number<std::int16_t>(at)
                       : type == 5123 ? number<std::uint16_t>(at)
                       : type == 5125 ? number<std::uint32_t>(at)
                                      : number<float>(at);
        if (accessor.value("normalized", false)) {
          value = std::max(-1.0, value / (type == 5120   ? 127
                                          : type == 5121 ? 255
                                          : type == 5122 ? 32767
                                                         : 65535));
        }
        all.back().push_back(value);
      }
    }
    return all;
  }

  void walk(std::size_t index, const Eigen::Matrix4d& above) {
    const auto& node = json_["nodes"].at(index);
    Eigen::Affine3d own = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      for (std::size_t k = 0; k < 16; ++k) {
        own.matrix()(static_cast<Eigen::Index>(k)) = node["matrix"][k];
      }
    }
    if (node.contains("translation")) {
      const auto& t = node["translation"];
      own.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    }
    if (node.contains("rotation")) {
      const auto& r = node["rotation"];
      own.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    }
    if (node.contains("scale")) {
      const auto& s = node["scale"];
      own.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    }
    frames_[index] = above * own.matrix();
    shown_.push_back(index);
    const auto children = node.value("children", std::vector<std::size_t>{});
    for (const std::size_t child : children) walk(child, frames_[index]);
  }

  [[nodiscard]] std::vector<Eigen::Matrix4d> moves_of(const nlohmann::json& skin) const {
    std::vector<Eigen::Matrix4d> moves;
    for (const std::size_t joint : skin["joints"]) moves.push_back(frames_.at(joint));
    if (!skin.contains("inverseBindMatrices")) return moves;
    const auto matrices = rows(skin["inverseBindMatrices"]);
    for (std::size_t k = 0; k < moves.size(); ++k) {
      moves[k] *= Eigen::Map<const Eigen::Matrix4d>(matrices[k].data());
    }
    return moves;
  }

  /// Of positions, normals or tangents; empty: there are none.
  [[nodiscard]] std::vector<std::vector<double>> morphed(const nlohmann::json& primitive,
                                                         const std::vector<double>& weights,
                                                         const char* name) const {
    if (!primitive["attributes"].contains(name)) return {};
    auto points = rows(primitive["attributes"][name]);
    for (std::size_t target = 0; target < weights.size(); ++target) {
      if (!primitive["targets"][target].contains(name)) continue;
      const auto shifts = rows(primitive["targets"][target][name]);
      for (std::size_t v = 0; v < points.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) points[v][k] += weights[target] * shifts[v][k];
      }
    }
    return points;
  }

  /// Normals as planes move, tangents as directions do.
  static void shade(Vertex& vertex, const Eigen::Matrix3d& linear,
                    const std::vector<double>* normal, const std::vector<double>* tangent) {
    if (normal != nullptr) {
      const Eigen::Map<const Eigen::Vector3d> given(normal->data());
      vertex.normal = (linear.inverse().transpose() * given).normalized();
    }
    if (tangent != nullptr) {
      const Eigen::Map<const Eigen::Vector3d> given(tangent->data());
      vertex.tangent << (linear * given).normalized(),
          (*tangent)[3] * (linear.determinant() < 0 ? -1 : 1);
    }
  }

  void append(std::vector<Vertex>& all, const nlohmann::json& primitive, const nlohmann::json& mesh,
              const nlohmann::json& node, const Eigen::Matrix4d& frame) const {
    const auto& attributes = primitive["attributes"];
    const std::vector<double> none;
    auto weights = node.value("weights", mesh.value("weights", none));
    if (!weights.empty() && !weights_.empty()) weights = weights_;
    const auto points = morphed(primitive, weights, "POSITION");
    const auto normals = morphed(primitive, weights, "NORMAL");
    const auto tangents = morphed(primitive, weights, "TANGENT");
    std::vector<Eigen::Matrix4d> moves(points.size(), frame);
    std::vector<double> sums(points.size(), 1);
    if (node.contains("skin") && attributes.contains("JOINTS_0")) {
      moves.assign(points.size(), Eigen::Matrix4d::Zero());
      sums.assign(points.size(), 0);
      const auto joints = moves_of(json_["skins"].at(node["skin"].get<std::size_t>()));
      for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
        const auto which = rows(attributes["JOINTS_" + std::to_string(set)]);
        const auto share = rows(attributes["WEIGHTS_" + std::to_string(set)]);
        for (std::size_t v = 0; v < points.size(); ++v) {
          for (std::size_t k = 0; k < 4; ++k) {
            if (share[v][k] == 0) continue;
            moves[v] += share[v][k] * joints.at(static_cast<std::size_t>(which[v][k]));
            sums[v] += share[v][k];
          }
        }
      }
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Eigen::Vector3d point(points[v][0], points[v][1], points[v][2]);
      const Eigen::Matrix4d move = moves[v] / (sums[v] > 0 ? sums[v] : 1);
      all.push_back({point, (move * point.homogeneous()).head<3>(), sums[v] > 0});
      shade(all.back(), move.topLeftCorner<3, 3>(), normals.empty() ? nullptr : &normals[v],
            tangents.empty() ? nullptr : &tangents[v]);
    }
  }

  nlohmann::json json_;
  std::vector<std::string> buffers_;
  std::vector<Eigen::Matrix4d> frames_;
  std::vector<std::size_t> shown_;  // nodes
  std::vector<double> weights_;
};

}  // namespace curveskel
