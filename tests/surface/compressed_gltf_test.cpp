// Laws of compressed glTF: what the libraries' own encoders have packed is read as what went in.
#include <draco/compression/encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/own_folder.hpp"
#include "tests/real_surfaces.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"
#include "tests/surface/reading.hpp"

namespace curveskel::compressed_gltf_laws {
namespace {

using Json = nlohmann::json;

/// A glTF file and its one buffer.
struct Parts {
  Json json;
  std::string bytes;
};

std::string uri_of(const std::string& bytes) {
  return "data:application/octet-stream;base64," + encodings::base64(bytes);
}

std::string text_of(Parts parts) {
  parts.json["buffers"][0] = {{"byteLength", parts.bytes.size()}, {"uri", uri_of(parts.bytes)}};
  return parts.json.dump();
}

std::string glb_of(Parts parts) {
  parts.json["buffers"][0] = {{"byteLength", parts.bytes.size()}};
  parts.bytes.resize((parts.bytes.size() + 3) / 4 * 4);
  std::string json = parts.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string glb = "glTF";
  const auto put = [&](std::size_t word) {
    rigged_bar::append(glb, static_cast<std::uint32_t>(word));
  };
  put(2);
  put(28 + json.size() + parts.bytes.size());
  put(json.size());
  glb += "JSON" + json;
  put(parts.bytes.size());
  return glb + std::string("BIN\0", 4) + parts.bytes;
}

const RiggedBar bent_bar{.joints = 9, .helper_nodes = true, .turn = 0.2};

/// The bar's JSON, and the bytes of each of its buffer views.
std::pair<Json, std::vector<std::string>> bar_and_views() {
  std::string buffer;
  Json json = Json::parse(gltf_of(bent_bar, &buffer));
  std::vector<std::string> views;
  for (const auto& view : json["bufferViews"]) {
    views.push_back(buffer.substr(view["byteOffset"].get<std::size_t>(),
                                  view["byteLength"].get<std::size_t>()));
  }
  return {std::move(json), std::move(views)};
}

/// The row's bytes in each view.
const std::map<int, std::size_t> size_of_type{{5121, 1}, {5123, 2}, {5126, 4}};
const std::map<std::string, std::size_t> width_of{
    {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};

std::string encoded_rows(const std::string& rows, std::size_t count, std::size_t stride) {
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
  auto* out = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(meshopt_encodeVertexBuffer(out, bytes.size(), rows.data(), count, stride));
  return bytes;
}

std::string encoded_indices(const std::string& rows, const std::string& mode) {
  std::vector<std::uint16_t> corners(rows.size() / 2);
  std::memcpy(corners.data(), rows.data(), rows.size());
  const bool triangles = mode == "TRIANGLES";
  const std::size_t count = corners.size();
  const auto bound = triangles ? meshopt_encodeIndexBufferBound : meshopt_encodeIndexSequenceBound;
  std::string bytes(bound(count, count), '\0');
  auto* out = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(triangles ? meshopt_encodeIndexBuffer(out, bytes.size(), corners.data(), count)
                         : meshopt_encodeIndexSequence(out, bytes.size(), corners.data(), count));
  return bytes;
}

/// `mode`: of the indices, TRIANGLES or INDICES.
Parts with_meshopt(const std::string& mode) {
  auto [json, views] = bar_and_views();
  const std::size_t indices = json["meshes"][0]["primitives"][0]["indices"];
  Parts packed{json, ""};
  for (std::size_t k = 0; k < views.size(); ++k) {  // accessor k has view k
    const Json& accessor = json["accessors"][k];
    const std::size_t count = accessor["count"];
    const std::size_t stride =
        size_of_type.at(accessor["componentType"]) * width_of.at(accessor["type"]);
    const bool is_index = k == indices;
    const std::string bytes =
        is_index ? encoded_indices(views[k], mode) : encoded_rows(views[k], count, stride);
    Json& view = packed.json["bufferViews"][k];
    view["buffer"] = 1;
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", packed.bytes.size()},
                                                     {"byteLength", bytes.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", is_index ? mode : "ATTRIBUTES"}};
    packed.bytes += bytes;
  }
  packed.json["buffers"] = {Json::object(),
                            {{"byteLength", 123456},
                             {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  packed.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  packed.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return packed;
}

/// `method`: draco::MESH_SEQUENTIAL_ENCODING or draco::MESH_EDGEBREAKER_ENCODING.
Parts with_draco(int method) {
  auto [json, views] = bar_and_views();
  auto& primitive = json["meshes"][0]["primitives"][0];
  const std::size_t positions = primitive["attributes"]["POSITION"];
  const std::size_t vertices = json["accessors"][positions]["count"];
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(vertices));
  Json ids;
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    const bool bytes = json["accessors"][accessor.get<std::size_t>()]["componentType"] == 5121;
    const int width = name == "POSITION" ? 3 : 4;
    draco::GeometryAttribute attribute;
    attribute.Init(
        name == "POSITION" ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC,
        nullptr, static_cast<signed char>(width), bytes ? draco::DT_UINT8 : draco::DT_FLOAT32,
        false, std::int64_t{width} * (bytes ? 1 : 4), 0);
    const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(vertices));
    const std::string& rows = views[accessor.get<std::size_t>()];
    for (std::uint32_t v = 0; v < vertices; ++v) {
      mesh.attribute(id)->SetAttributeValue(
          draco::AttributeValueIndex(v),
          rows.data() + static_cast<std::size_t>(mesh.attribute(id)->byte_stride()) * v);
    }
    ids[name] = mesh.attribute(id)->unique_id();
  }
  const std::string& corners = views[primitive["indices"].get<std::size_t>()];
  for (std::size_t at = 0; at < corners.size(); at += 6) {
    std::array<std::uint16_t, 3> corner{};
    std::memcpy(corner.data(), corners.data() + at, 6);
    mesh.AddFace(
        {draco::PointIndex(corner[0]), draco::PointIndex(corner[1]), draco::PointIndex(corner[2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  Parts packed{json, {buffer.data(), buffer.size()}};
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    packed.json["accessors"][accessor.get<std::size_t>()].erase("bufferView");
  }
  packed.json["accessors"][primitive["indices"].get<std::size_t>()].erase("bufferView");
  const std::size_t matrices = json["skins"][0]["inverseBindMatrices"];
  packed.json["accessors"][matrices]["bufferView"] = 1;
  packed.json["bufferViews"] = {
      {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", packed.bytes.size()}},
      {{"buffer", 0}, {"byteOffset", packed.bytes.size()}, {"byteLength", views[matrices].size()}}};
  packed.bytes += views[matrices];
  packed.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", ids}};
  packed.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  packed.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return packed;
}

/// Triangles from the least corner on, sorted: no encoder keeps more.
Outlines sorted_outlines(const std::filesystem::path& file) {
  Outlines all = outlines(read_polygons(file, {}));
  for (auto& triangle : all) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::pair<std::string, Parts>> packed_bars() {
  return {{"meshopt triangles", with_meshopt("TRIANGLES")},
          {"meshopt sequence", with_meshopt("INDICES")},
          {"Draco sequential", with_draco(draco::MESH_SEQUENTIAL_ENCODING)},
          {"Draco by edges", with_draco(draco::MESH_EDGEBREAKER_ENCODING)}};
}

TEST(CompressedGltf, IsReadAsWhatWentIn) {
  const OwnFolder folder;
  const auto plain = folder.write("plain.gltf", gltf_of(bent_bar));
  const Outlines expected = sorted_outlines(plain);
  const auto rig = read_rig(plain, {});
  ASSERT_TRUE(rig);
  const Eigen::RowVectorXf shares = Eigen::RowVectorXf::Ones(rig->weights.rows()) * rig->weights;
  for (const auto& [name, parts] : packed_bars()) {
    SCOPED_TRACE(name);
    for (const auto& file :
         {folder.write("x.gltf", text_of(parts)), folder.write("x.glb", glb_of(parts))}) {
      EXPECT_EQ(sorted_outlines(file), expected);
      const auto found = read_rig(file, {});
      ASSERT_TRUE(found);
      EXPECT_EQ(found->joints, rig->joints);
      const Eigen::RowVectorXf sums =
          Eigen::RowVectorXf::Ones(found->weights.rows()) * found->weights;
      EXPECT_LT((sums - shares).cwiseAbs().maxCoeff(), 1e-5F);
    }
  }
}

TEST(CompressedGltf, IsMadePlainWhereARigIsPutIntoIt) {
  const OwnFolder folder;
  for (const auto& [name, parts] : packed_bars()) {
    SCOPED_TRACE(name);
    const auto file = folder.write("x.glb", glb_of(parts));
    const PolygonSoup soup = read_polygons(file, {}, {true});
    const Rig rig = random_rig(soup.positions.rows(), 5, "bone ");
    const auto edited = format_rig_into(file, rig, {RigFormat::glb, OldRig::replaced, "rig", ""});
    ASSERT_TRUE(edited);
    for (const char* extension : {"EXT_meshopt_compression", "KHR_draco_mesh_compression"}) {
      EXPECT_EQ(edited->bytes.find(extension), std::string::npos);
    }
    EXPECT_EQ(edited->bytes.find("extensions"), std::string::npos);
    const auto path = folder.write("edited.glb", edited->bytes);
    const PolygonSoup found = read_polygons(path, {});
    ASSERT_EQ(found.positions.rows(), soup.positions.rows());
    EXPECT_LT((found.positions - soup.positions).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(found.corners, soup.corners);
    const auto vertices = GltfByTheRule(path).vertices();
    ASSERT_EQ(vertices.size(), static_cast<std::size_t>(soup.positions.rows()));
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const auto row = soup.positions.row(static_cast<Eigen::Index>(v));
      EXPECT_LT((vertices[v].placed.transpose() - row).norm(), 1e-5) << v;
    }
  }
}

/// Read or refused; with AddressSanitizer a byte beyond a buffer would show.
TEST(CompressedGltf, BrokenDataAreReadOrRefusedByName) {
  const OwnFolder folder;
  for (const auto& [name, parts] : packed_bars()) {
    SCOPED_TRACE(name);
    int refused = 0;
    for (std::size_t at = 0; at < parts.bytes.size(); at += 1 + parts.bytes.size() / 150) {
      Parts broken = parts;
      broken.bytes[at] = static_cast<char>(broken.bytes[at] ^ static_cast<char>(1U << at % 8));
      const auto file = folder.write("broken.glb", glb_of(broken));
      try {
        (void)read_polygons(file, {});
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        EXPECT_NE(std::string(error.what()).find("broken.glb"), std::string::npos);
        ++refused;
      }
    }
    EXPECT_GT(refused, 0);
  }
}

TEST(CompressedGltf, AnnouncesNoMoreThanItsBytesCanHold) {
  const OwnFolder folder;
  const auto message = [&](const Parts& parts) {
    return refusal(folder.write("liar.glb", glb_of(parts)));
  };
  Parts meshopt = with_meshopt("TRIANGLES");
  for (const std::size_t view : {0U, 1U, 2U, 3U}) {
    Parts liar = meshopt;
    auto& extension = liar.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
    extension["count"] = 2'000'000'001 / 3 * 3;
    EXPECT_NE(message(liar).find(" rows in "), std::string::npos) << view;
    extension["count"] = -1;
    EXPECT_NE(message(liar).find("no valid count"), std::string::npos) << view;
  }
  Parts draco = with_draco(draco::MESH_SEQUENTIAL_ENCODING);
  draco.bytes.replace(11, 5, "\xff\xff\xff\xff\x0f");
  EXPECT_NE(message(draco).find("4294967295 faces"), std::string::npos);
}

TEST(CompressedGltf, OfTheCollectionIsReadWithItsSkin) {
  const auto file = real_surface("real/quaternius-Enemy_Large-transformed.glb");
  if (!file) GTEST_SKIP() << "needs the collection of surfaces";
  const PolygonSoup soup = read_polygons(*file, {});
  EXPECT_EQ(soup.positions.rows(), 3485);
  EXPECT_EQ(soup.offsets.size(), 14172U / 3 + 1);
  const auto rig = read_rig(*file, {});
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->joints.rows(), 43);
  EXPECT_EQ(rig->weights.rows(), 3485);
}

}  // namespace
}  // namespace curveskel::compressed_gltf_laws
