// glTF files of which every byte is known, in the ways in which files of production differ.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/write_file.hpp>
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel {

struct EditCase {
  std::string name;
  bool text = false;         ///< .gltf with its buffers and pictures beside it
  bool nested = false;       ///< nodes with translation, rotation and uneven scale
  bool interleaved = false;  ///< positions and normals in one view
  bool sparse = false;       ///< some positions replaced
  bool quantised = false;    ///< positions as words, brought to size by the node
  bool morphed = false;      ///< two targets, one of them with a weight
  bool instanced = false;    ///< one mesh under three nodes, one of them in another scene
  bool rich = false;         ///< materials, pictures, extras, extensions, UV, colours
  bool shaded = false;       ///< normals and tangents, of morph targets, too
  bool loose = false;        ///< points and lines beside the triangles
  int old_rig = 0;           ///< joints of a rig that is there
  double old_turn = 0;       ///< of its joints against their bind pose
  bool cm = false;           ///< the old skin was bound in other units
};

inline std::vector<EditCase> edit_cases() {
  return {{.name = "static"},
          {.name = "nested", .nested = true},
          {.name = "interleaved", .nested = true, .interleaved = true},
          {.name = "buffers", .text = true, .nested = true},
          {.name = "sparse", .sparse = true},
          {.name = "quantised", .quantised = true},
          {.name = "morphed", .nested = true, .morphed = true},
          {.name = "instanced", .nested = true, .instanced = true},
          {.name = "rich", .nested = true, .interleaved = true, .rich = true},
          {.name = "rich text", .text = true, .rich = true, .loose = true},
          {.name = "loose", .nested = true, .loose = true},
          {.name = "rigged", .rich = true, .old_rig = 5},
          {.name = "rigged, with much else",
           .text = true,
           .nested = true,
           .interleaved = true,
           .morphed = true,
           .instanced = true,
           .rich = true,
           .loose = true,
           .old_rig = 5},
          {.name = "rigged in cm", .nested = true, .old_rig = 4, .cm = true},
          {.name = "posed", .nested = true, .rich = true, .old_rig = 4, .old_turn = 0.4}};
}

/// Writes the file of a case; keeps what went into it.
class EditSubject {
 public:
  EditSubject(const std::filesystem::path& folder, const EditCase& wanted)
      : case_(wanted), path_(folder / (wanted.name + (wanted.text ? ".gltf" : ".glb"))) {
    buffers_.resize(wanted.text ? 2 : 1);
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "by hand"}}}, {"scene", 0}};
    json_["scenes"] = {{{"nodes", Json::array()}}};
    add_meshes();
    if (wanted.rich) add_riches(folder);
    add_nodes();
    if (wanted.old_rig > 0) add_old_rig();
    write(folder);
  }

  using Json = nlohmann::json;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const Json& json() const { return json_; }
  [[nodiscard]] const std::vector<std::string>& buffers() const { return buffers_; }

 private:
  template <typename Value>
  static void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  std::size_t add_view(const std::string& bytes, std::size_t stride = 0) {
    std::string& buffer =
        buffers_[json_.value("bufferViews", Json::array()).size() % buffers_.size()];
    const std::size_t index = &buffer == buffers_.data() ? 0 : 1;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    Json view{{"buffer", index}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    buffer += bytes;
    json_["bufferViews"].push_back(view);
    return json_["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(std::size_t view, std::size_t offset, int component, const char* type,
                           std::size_t count) {
    Json accessor{
        {"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (offset > 0) accessor["byteOffset"] = offset;
    json_["accessors"].push_back(accessor);
    return json_["accessors"].size() - 1;
  }

  std::size_t add_rows(const std::string& bytes, int component, const char* type,
                       std::size_t count) {
    return add_accessor(add_view(bytes), 0, component, type, count);
  }

  void set_bounds(std::size_t accessor, const Eigen::MatrixXf& rows) {
    for (Eigen::Index k = 0; k < rows.cols(); ++k) {
      json_["accessors"][accessor]["min"].push_back(rows.col(k).minCoeff());
      json_["accessors"][accessor]["max"].push_back(rows.col(k).maxCoeff());
    }
  }

  [[nodiscard]] static std::string floats_of(const Eigen::MatrixXf& rows) {
    std::string bytes;
    for (Eigen::Index row = 0; row < rows.rows(); ++row) {
      for (Eigen::Index k = 0; k < rows.cols(); ++k) put(bytes, rows(row, k));
    }
    return bytes;
  }

  std::size_t add_floats(const Eigen::MatrixXf& rows, const char* type, bool bounds = false) {
    const std::size_t accessor = add_rows(floats_of(rows), 5126, type, idx(rows.rows()));
    if (bounds) set_bounds(accessor, rows);
    return accessor;
  }

  /// Positions, and normals where they are interleaved.
  Json add_places(const Eigen::MatrixXf& places) {
    const auto count = idx(places.rows());
    if (case_.quantised) {
      std::string bytes;
      const Eigen::MatrixXf rounded = (places * 5000).array().round();
      for (Eigen::Index row = 0; row < rounded.rows(); ++row) {
        for (int k = 0; k < 3; ++k) put(bytes, static_cast<std::int16_t>(rounded(row, k)));
        put(bytes, std::int16_t{0});
      }
      const std::size_t accessor = add_accessor(add_view(bytes, 8), 0, 5122, "VEC3", count);
      set_bounds(accessor, rounded);
      json_["extensionsUsed"] = {"KHR_mesh_quantization"};
      json_["extensionsRequired"] = {"KHR_mesh_quantization"};
      return {{"POSITION", accessor}};
    }
    if (case_.interleaved) {
      Eigen::MatrixXf rows(places.rows(), 6);
      rows << places, places.rowwise().normalized();
      const std::size_t view = add_view(floats_of(rows), 24);
      const std::size_t positions = add_accessor(view, 0, 5126, "VEC3", count);
      set_bounds(positions, places);
      return {{"POSITION", positions}, {"NORMAL", add_accessor(view, 12, 5126, "VEC3", count)}};
    }
    const std::size_t accessor = add_floats(places, "VEC3", true);
    if (case_.sparse) {
      std::string rows;
      std::string values;
      for (const int row : {2, 5}) {
        put(rows, static_cast<std::uint16_t>(row));
        for (int k = 0; k < 3; ++k) put(values, 0.9F * places(row, k));
      }
      const std::size_t where = add_view(rows);
      json_["accessors"][accessor]["sparse"] = {
          {"count", 2},
          {"indices", {{"bufferView", where}, {"componentType", 5123}}},
          {"values", {{"bufferView", add_view(values)}}}};
    }
    return {{"POSITION", accessor}};
  }

  /// A torus of two primitives that share their vertices, and a part of its own beside it.
  void add_meshes() {
    const Surface torus = torus_surface();
    const Eigen::MatrixXf places = torus.positions.cast<float>();
    Json attributes = add_places(places);
    if (case_.old_rig > 0) add_old_weights(attributes, places);
    if (case_.shaded) add_shades(attributes, places);
    Json targets = Json::array();
    for (const float factor : {0.1F, -0.2F}) {
      if (!case_.morphed) break;
      targets.push_back({{"POSITION", add_floats(factor * places, "VEC3", true)}});
      if (!case_.shaded) continue;
      const Eigen::MatrixXf tilts = factor * places.rowwise().reverse();
      targets.back()["NORMAL"] = add_floats(tilts, "VEC3");
      targets.back()["TANGENT"] = add_floats(-tilts, "VEC3");
    }
    Json primitives = Json::array();
    const Eigen::Index half = torus.triangles.rows() / 2;
    for (const bool first : {true, false}) {
      std::string corners;
      const Eigen::Index begin = first ? 0 : half;
      const Eigen::Index end = first ? half : torus.triangles.rows();
      for (Eigen::Index f = begin; f < end; ++f) {
        for (const int v : torus.triangles.row(f)) put(corners, static_cast<std::uint16_t>(v));
      }
      primitives.push_back(
          {{"attributes", attributes},
           {"indices", add_rows(corners, 5123, "SCALAR", idx(3 * (end - begin)))}});
      if (case_.morphed) primitives.back()["targets"] = targets;
    }
    json_["meshes"].push_back({{"name", "body"}, {"primitives", primitives}});
    if (case_.morphed) json_["meshes"][0]["weights"] = {0.5, 0};
    add_small_mesh();
  }

  void add_shades(Json& attributes, const Eigen::MatrixXf& places) {
    attributes["NORMAL"] = add_floats(places.rowwise().normalized(), "VEC3");
    Eigen::MatrixXf tangents(places.rows(), 4);
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
      const Eigen::Vector3f place = places.row(v).transpose();
      tangents.row(v) << place.cross(Eigen::Vector3f::UnitZ()).normalized().transpose(),
          v % 2 == 0 ? 1 : -1;
    }
    attributes["TANGENT"] = add_floats(tangents, "VEC4");
  }

  void add_small_mesh() {
    const Surface small = shapes::torus(1, 0.4, 8).surface;
    const Eigen::MatrixXf places = small.positions.cast<float>();
    std::string corners;
    for (const auto& triangle : small.triangles.rowwise()) {
      for (const int v : triangle) put(corners, static_cast<std::uint32_t>(v));
    }
    Json attributes = add_places(places);
    if (case_.rich) {
      attributes["TEXCOORD_0"] = add_floats(places.leftCols<2>(), "VEC2");
      attributes["TEXCOORD_1"] = add_floats(places.rightCols<2>(), "VEC2");
      attributes["COLOR_0"] = add_floats(places.cwiseAbs().cwiseMin(1), "VEC3");
      attributes["_MINE"] = add_floats(places.leftCols<1>(), "SCALAR");
    }
    Json primitives{{{"attributes", attributes},
                     {"indices", add_rows(corners, 5125, "SCALAR", idx(small.triangles.size()))}}};
    if (case_.loose) {
      const Eigen::MatrixXf points = 1.05F * places.topRows(7);
      primitives.push_back(
          {{"attributes", {{"POSITION", add_floats(points, "VEC3", true)}}}, {"mode", 0}});
      primitives.push_back({{"attributes", attributes}, {"mode", 1}});
      if (places.rows() % 2 == 1) primitives.erase(2);
    }
    json_["meshes"].push_back({{"name", "small"}, {"primitives", primitives}});
  }

  void add_riches(const std::filesystem::path& folder) {
    const std::string picture("\x89PNG\r\n\x1a\n not a true picture", 27);
    if (case_.text) {
      write_file(folder / "a picture.png", picture);
      json_["images"] = {{{"uri", "a%20picture.png"}, {"name", "skin"}}};
    } else {
      json_["images"] = {{{"bufferView", add_view(picture)}, {"mimeType", "image/png"}}};
    }
    json_["samplers"] = {{{"wrapS", 33071}}};
    json_["textures"] = {{{"source", 0}, {"sampler", 0}}};
    json_["materials"] = {
        {{"name", "cloth"},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}},
         {"extensions", {{"KHR_materials_ior", {{"ior", 1.4}}}}}},
        {{"name", "eyes"}, {"emissiveFactor", {0.1, 0.2, 0.30000001192092896}}}};
    json_["extensionsUsed"] = {"KHR_materials_ior", "MINE_unheard_of"};
    json_["extensions"]["MINE_unheard_of"] = {{"deep", {1, {{"b", nullptr}}, "ü"}}};
    json_["extras"] = {{"z", 1}, {"a", {true, 1e-30}}};
    json_["meshes"][0]["primitives"][0]["material"] = 0;
    json_["meshes"][0]["primitives"][1]["material"] = 1;
    json_["meshes"][0]["extras"] = {{"targetNames", {"smile", "frown"}}};
    json_["meshes"][1]["primitives"][0]["material"] = 1;
    json_["meshes"][1]["primitives"][0]["extras"] = {{"lod", 2}};
    json_["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
  }

  std::size_t add_node(Json node, int parent = -1) {
    json_["nodes"].push_back(std::move(node));
    const std::size_t index = json_["nodes"].size() - 1;
    if (parent >= 0) {
      json_["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(index);
    } else {
      json_["scenes"][0]["nodes"].push_back(index);
    }
    return index;
  }

  void add_nodes() {
    int parent = -1;
    if (case_.nested) {
      parent = static_cast<int>(add_node({{"name", "holder rig"},
                                          {"translation", {1, -2, 0.5}},
                                          {"rotation", {0.5, 0.5, 0.5, 0.5}},
                                          {"scale", {2, 3, 0.5}}}));
    }
    Json body{{"name", "body"}, {"mesh", 0}};
    if (case_.nested) body["rotation"] = {0, 0.6, 0, 0.8};
    if (case_.quantised) body["scale"] = {0.0002, 0.0002, 0.0002};
    if (case_.old_rig > 0) body["skin"] = 0;
    add_node(body, parent);
    Json small{{"name", "small"}, {"mesh", 1}, {"translation", {0, 4, 0}}};
    if (case_.quantised) small["scale"] = {0.0002, 0.0002, 0.0002};
    if (case_.rich) small["extras"] = {{"part", "ring"}};
    add_node(small, parent);
    if (case_.rich) add_node({{"name", "camera"}, {"camera", 0}}, parent);
    if (!case_.instanced) return;
    add_node({{"name", "second"}, {"mesh", 1}, {"translation", {0, -6, 0}}}, parent);
    add_node({{"name", "mirrored"}, {"mesh", 1}, {"translation", {0, 0, 6}}, {"scale", {-1, 1, 1}}},
             parent);
    json_["nodes"].push_back({{"name", "elsewhere"}, {"mesh", 1}});
    json_["scenes"].push_back({{"nodes", {json_["nodes"].size() - 1}}});
  }

  void add_old_weights(Json& attributes, const Eigen::MatrixXf& places) {
    const auto count = idx(places.rows());
    for (int set = 0; set < 2; ++set) {
      std::string joints;
      std::string shares;
      for (Eigen::Index row = 0; row < places.rows(); ++row) {
        for (int k = 0; k < 4; ++k) {
          put(joints, static_cast<std::uint8_t>((row + k + set) % case_.old_rig));
          put(shares, set == 0 ? 0.25F : 0.0F);
        }
      }
      const std::string number = std::to_string(set);
      attributes["JOINTS_" + number] = add_rows(joints, 5121, "VEC4", count);
      attributes["WEIGHTS_" + number] = add_rows(shares, 5126, "VEC4", count);
    }
  }

  /// A chain of joints below an armature; the small mesh hangs from the second, a helper from the
  /// last; all but the armature and the mesh are moved by an animation.
  void add_old_rig() {
    const double unit = case_.cm ? 0.01 : 1;
    const auto holder =
        static_cast<int>(add_node({{"name", "old armature"}, {"scale", {unit, unit, unit}}}));
    Json joints = Json::array();
    std::string matrices;
    int parent = holder;
    for (int joint = 0; joint < case_.old_rig; ++joint) {
      Json node{{"name", "old " + std::to_string(joint)},
                {"translation", {joint == 0 ? 0 : 1 / unit, 0, 0}}};
      if (case_.old_turn != 0) {
        node["rotation"] = {0, 0, std::sin(case_.old_turn / 2), std::cos(case_.old_turn / 2)};
      }
      parent = static_cast<int>(add_node(node, parent));
      joints.push_back(parent);
      Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
      inverse.topLeftCorner<3, 3>() *= static_cast<float>(case_.cm ? 100 : 1);
      inverse(0, 3) = static_cast<float>(-joint / unit);
      for (Eigen::Index k = 0; k < 16; ++k) put(matrices, inverse(k));
    }
    add_node({{"name", "old helper"}}, parent);
    const auto hand = static_cast<std::size_t>(holder) + 2;
    json_["nodes"][hand]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", "sword"}, {"mesh", 1}, {"translation", {0, 0, 3}}});
    json_["skins"] = {
        {{"joints", joints},
         {"skeleton", holder},
         {"inverseBindMatrices", add_rows(matrices, 5126, "MAT4", idx(case_.old_rig))}}};
    add_old_animation(joints);
  }

  void add_old_animation(const Json& joints) {
    std::string times;
    std::string turns;
    for (const float time : {0.0F, 1.0F}) {
      put(times, time);
      for (const float number : {0.0F, 0.0F, 0.0F, 1.0F}) put(turns, number);
    }
    const std::size_t input = add_rows(times, 5126, "SCALAR", 2);
    json_["accessors"][input]["min"] = {0};
    json_["accessors"][input]["max"] = {1};
    const Json sampler{{"input", input}, {"output", add_rows(turns, 5126, "VEC4", 2)}};
    const auto channel = [&](const Json& node) -> Json {
      return {{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}};
    };
    json_["animations"] = {
        {{"name", "walk"}, {"samplers", {sampler}}, {"channels", {channel(joints.back())}}},
        {{"name", "both"},
         {"samplers", {sampler}},
         {"channels", {channel(joints.back()), channel(0)}}}};
  }

  void write(const std::filesystem::path& folder) {
    for (std::size_t k = 0; k < buffers_.size(); ++k) {
      json_["buffers"].push_back({{"byteLength", buffers_[k].size()}});
      if (!case_.text) continue;
      if (k == 0) {
        json_["buffers"][k]["uri"] = case_.name + ".bin";
        write_file(folder / (case_.name + ".bin"), buffers_[k]);
      } else {
        json_["buffers"][k]["uri"] =
            "data:application/octet-stream;base64," + encodings::base64(buffers_[k]);
      }
    }
    std::string text = json_.dump();
    if (!case_.text) {
      text.resize((text.size() + 3) / 4 * 4, ' ');
      std::string numbers = buffers_[0];
      numbers.resize((numbers.size() + 3) / 4 * 4);
      std::string bytes = "glTF";
      put(bytes, std::uint32_t{2});
      put(bytes, static_cast<std::uint32_t>(28 + text.size() + numbers.size()));
      put(bytes, static_cast<std::uint32_t>(text.size()));
      bytes += "JSON" + text;
      put(bytes, static_cast<std::uint32_t>(numbers.size()));
      bytes += std::string("BIN\0", 4) + numbers;
      text = bytes;
    }
    write_file(path_, text);
  }

  const EditCase case_;
  std::filesystem::path path_;
  Json json_;
  std::vector<std::string> buffers_;
};

}  // namespace curveskel
