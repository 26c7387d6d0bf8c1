#include "rig/fbx/fbx_materials.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_mesh.hpp"

namespace curveskel {
namespace {

struct Look {
  std::array<double, 4> colour{1, 1, 1, 1};
  std::array<double, 3> light{};
  double roughness = 1;
  double metal = 0;
};

Look look_of(const tinygltf::Material& material) {
  Look look;
  const auto& given = material.pbrMetallicRoughness;
  std::copy_n(given.baseColorFactor.begin(), std::min<std::size_t>(4, given.baseColorFactor.size()),
              look.colour.begin());
  std::copy_n(material.emissiveFactor.begin(),
              std::min<std::size_t>(3, material.emissiveFactor.size()), look.light.begin());
  look.roughness = given.roughnessFactor;
  look.metal = given.metallicFactor;
  return look;
}

void write_material(FbxRecords& records, const Look& look) {
  records.record("Version", 102);
  records.record("ShadingModel", "phong");
  records.record("MultiLayer", 0);
  records.begin("Properties70");
  const auto colour = [&](const char* name, const auto& values) {
    records.property(name, "Color", "", "A", values[0], values[1], values[2]);
  };
  const auto number = [&](const char* name, double value) {
    records.property(name, "Number", "", "A", value);
  };
  colour("DiffuseColor", look.colour);
  colour("EmissiveColor", look.light);
  number("EmissiveFactor", look.light == std::array<double, 3>{} ? 0 : 1);
  number("TransparencyFactor", 1 - look.colour[3]);
  number("Opacity", look.colour[3]);
  // Blender reads roughness as 1 - sqrt(shininess) / 10.
  const double smooth = 10 * (1 - look.roughness);
  number("Shininess", smooth * smooth);
  number("ShininessExponent", smooth * smooth);
  number("ReflectionFactor", look.metal);
  records.end();
}

/// The formats of pictures by their first bytes.
std::string extension_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  if (bytes.starts_with("\xff\xd8")) return ".jpg";
  if (bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") return ".webp";
  return "";
}

class MaterialWriter {
 public:
  MaterialWriter(FbxDocument& document, const tinygltf::Model& model)
      : document_(document), model_(model) {}

  std::int64_t add(const tinygltf::Material& given) {
    const Look look = look_of(given);
    const std::int64_t material =
        document_.add("Material", given.name, "Material", "",
                      [look](FbxRecords& records) { write_material(records, look); });
    const tinygltf::TextureInfo& colour = given.pbrMetallicRoughness.baseColorTexture;
    add_texture(material, "DiffuseColor", colour.index, colour.texCoord);
    if (given.alphaMode != "OPAQUE" && !given.alphaMode.empty()) {
      add_texture(material, "TransparentColor", colour.index, colour.texCoord);
    }
    add_texture(material, "NormalMap", given.normalTexture.index, given.normalTexture.texCoord);
    add_texture(material, "EmissiveColor", given.emissiveTexture.index,
                given.emissiveTexture.texCoord);
    return material;
  }

 private:
  void add_texture(std::int64_t material, std::string_view property, int number, int map) {
    if (number < 0 || idx(number) >= model_.textures.size()) return;
    const int image = model_.textures[idx(number)].source;
    if (image < 0 || idx(image) >= model_.images.size()) return;
    document_.connect(texture_of(image, idx(std::max(map, 0))), material, property);
  }

  std::int64_t texture_of(int image, std::size_t map) {
    const auto found = textures_.find({image, map});
    if (found != textures_.end()) return found->second;
    const std::string file = file_name(image);
    const std::string map_name = fbx_map_name(map);
    const std::int64_t texture = document_.add(
        "Texture", picture_name(image), "Texture", "", [file, map_name](FbxRecords& records) {
          records.record("Type", "TextureVideoClip");
          records.record("Version", 202);
          records.record("FileName", file);
          records.record("RelativeFilename", file);
          records.begin("Properties70");
          records.property("UVSet", "KString", "", "", map_name);
          records.property("UseMaterial", "bool", "", "", 1);
          records.end();
        });
    document_.connect(video_of(image), texture);
    textures_.emplace(std::pair(image, map), texture);
    return texture;
  }

  /// One for all textures that show the picture.
  std::int64_t video_of(int image) {
    const auto found = videos_.find(image);
    if (found != videos_.end()) return found->second;
    const std::string file = file_name(image);
    const std::string bytes(bytes_of(image));
    const std::int64_t video = document_.add("Video", picture_name(image), "Video", "Clip",
                                             [file, bytes](FbxRecords& records) {
                                               records.record("Type", "Clip");
                                               records.record("FileName", file);
                                               records.record("RelativeFilename", file);
                                               if (bytes.empty()) return;
                                               records.begin("Content");
                                               records.add_bytes(bytes);
                                               records.end();
                                             });
    videos_.emplace(image, video);
    return video;
  }

  [[nodiscard]] std::string_view bytes_of(int image) const {
    const int number = model_.images[idx(image)].bufferView;
    if (number < 0 || idx(number) >= model_.bufferViews.size()) return {};
    const tinygltf::BufferView& view = model_.bufferViews[idx(number)];
    if (view.buffer < 0 || idx(view.buffer) >= model_.buffers.size()) return {};
    const std::vector<unsigned char>& data = model_.buffers[idx(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) return {};
    return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
  }

  [[nodiscard]] std::string picture_name(int image) const {
    const std::string& name = model_.images[idx(image)].name;
    return name.empty() ? "picture " + std::to_string(image + 1) : name;
  }

  [[nodiscard]] std::string file_name(int image) const {
    const tinygltf::Image& given = model_.images[idx(image)];
    if (!given.uri.empty() && !given.uri.starts_with("data:")) return given.uri;
    std::string name = picture_name(image);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c == ':'; }, '_');
    const std::string extension = extension_of(bytes_of(image));
    return name.ends_with(extension) ? name : name + extension;
  }

  FbxDocument& document_;
  const tinygltf::Model& model_;
  std::map<int, std::int64_t> videos_;                            // by image
  std::map<std::pair<int, std::size_t>, std::int64_t> textures_;  // by image and map
};

}  // namespace

std::vector<std::int64_t> add_fbx_materials(FbxDocument& document, const tinygltf::Model& model) {
  MaterialWriter writer(document, model);
  std::vector<std::int64_t> numbers;
  numbers.reserve(model.materials.size());
  for (const tinygltf::Material& material : model.materials) {
    numbers.push_back(writer.add(material));
  }
  return numbers;
}

std::int64_t add_fbx_plain_material(FbxDocument& document) {
  return document.add("Material", "material", "Material", "",
                      [](FbxRecords& records) { write_material(records, Look()); });
}

}  // namespace curveskel
