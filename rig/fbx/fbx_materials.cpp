#include "rig/fbx/fbx_materials.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/indices.hpp>
#include "rig/fbx/fbx_set_names.hpp"
#include "rig/gltf/extension_numbers.hpp"
#include "rig/gltf/texture_transform.hpp"

namespace curveskel {
namespace {

struct Look {
  std::array<double, 4> colour{1, 1, 1, 1};
  std::array<double, 3> light{};
  double light_strength = 1;
  double roughness = 1;
  double metal = 0;
  double normal_strength = 1;
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
  look.light_strength =
      number_in(material.extensions, emissive_strength_extension, "emissiveStrength", 1);
  look.normal_strength = material.normalTexture.scale;
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
  number("EmissiveFactor", look.light == std::array<double, 3>{} ? 0 : look.light_strength);
  number("TransparencyFactor", 1 - look.colour[3]);
  number("Opacity", look.colour[3]);
  // Blender reads roughness as 1 - sqrt(shininess) / 10.
  const double smooth = 10 * (1 - look.roughness);
  number("Shininess", smooth * smooth);
  number("ShininessExponent", smooth * smooth);
  number("ReflectionFactor", look.metal);
  number("BumpFactor", look.normal_strength);
  records.end();
}

/// As Blender has it: the inverse of the scale, and radians to the other side.
void write_transform(FbxRecords& records, const TextureTransform& transform) {
  if (transform == TextureTransform()) return;
  const auto inverse = [](double scale) { return scale == 0 ? 1 : 1 / scale; };
  const auto vector = [&](const char* name, double x, double y, double z) {
    records.property(name, "Vector", "", "A", x, y, z);
  };
  vector("Translation", transform.shift[0], transform.shift[1], 0);
  vector("Rotation", 0, 0, -transform.turn);
  vector("Scaling", inverse(transform.scale[0]), inverse(transform.scale[1]), 1);
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
  MaterialWriter(FbxDocument& document, const tinygltf::Model& model,
                 const std::vector<std::vector<std::string>>& map_names)
      : document_(document), model_(model), names_of_mesh_(map_names) {
    for (int image = 0; idx(image) < model.images.size(); ++image) add_file_name(image);
  }

  std::int64_t add(int number) {
    const tinygltf::Material& given = model_.materials[idx(number)];
    map_names_ = map_names_with(number);
    const Look look = look_of(given);
    const std::int64_t material =
        document_.add("Material", given.name, "Material", "",
                      [look](FbxRecords& records) { write_material(records, look); });
    const tinygltf::TextureInfo& colour = given.pbrMetallicRoughness.baseColorTexture;
    add_texture(material, "DiffuseColor", colour);
    if (given.alphaMode != "OPAQUE" && !given.alphaMode.empty()) {
      add_texture(material, "TransparentColor", colour);
    }
    add_texture(material, "NormalMap", given.normalTexture);
    add_texture(material, "EmissiveColor", given.emissiveTexture);
    return material;
  }

 private:
  template <typename TextureInfo>
  void add_texture(std::int64_t material, std::string_view property, const TextureInfo& info) {
    if (info.index < 0 || idx(info.index) >= model_.textures.size()) return;
    const int image = model_.textures[idx(info.index)].source;
    if (image < 0 || idx(image) >= model_.images.size()) return;
    const double map = number_in(info.extensions, texture_transform_extension, "texCoord",
                                 static_cast<double>(info.texCoord));
    const bool is_there = map >= 0 && map < static_cast<double>(map_names_.size());
    const TextureUse use{image,
                         is_there ? map_names_[static_cast<std::size_t>(map)] : fbx_maps.name,
                         transform_in(info.extensions)};
    document_.connect(texture_of(use), material, property);
  }

  /// Of the mesh with that material that has most.
  [[nodiscard]] std::vector<std::string> map_names_with(int material) const {
    const auto has_it = [&](const tinygltf::Primitive& primitive) {
      return primitive.material == material;
    };
    std::vector<std::string> names;
    for (std::size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
      const std::vector<std::string>& own = names_of_mesh_[mesh];
      const bool has_more = own.size() > names.size();
      if (has_more && std::ranges::any_of(model_.meshes[mesh].primitives, has_it)) names = own;
    }
    return names;
  }

  struct TextureUse {
    int image = 0;
    std::string map;  ///< its name
    TextureTransform transform;

    bool operator==(const TextureUse&) const = default;
  };

  std::int64_t texture_of(const TextureUse& use) {
    const auto found =
        std::ranges::find(textures_, use, &std::pair<TextureUse, std::int64_t>::first);
    if (found != textures_.end()) return found->second;
    const std::string file = files_[idx(use.image)];
    const std::int64_t texture = document_.add(
        "Texture", picture_name(use.image), "Texture", "", [file, use](FbxRecords& records) {
          records.record("Type", "TextureVideoClip");
          records.record("Version", 202);
          records.record("FileName", file);
          records.record("RelativeFilename", file);
          records.begin("Properties70");
          records.property("UVSet", "KString", "", "", use.map);
          records.property("UseMaterial", "bool", "", "", 1);
          write_transform(records, use.transform);
          records.end();
        });
    document_.connect(video_of(use.image), texture);
    textures_.emplace_back(use, texture);
    return texture;
  }

  /// One for all textures that show the picture.
  std::int64_t video_of(int image) {
    const auto found = videos_.find(image);
    if (found != videos_.end()) return found->second;
    const std::string file = files_[idx(image)];
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

  /// Programs know pictures by these names, and some unpack them into one folder: so no two are
  /// alike, in letters of either case.
  void add_file_name(int image) {
    const std::string wanted = file_name(image);
    const std::size_t begin = wanted.find_last_of("/\\") + 1;  // 0 without folders
    const std::size_t last = wanted.rfind('.');
    const std::size_t dot = last == std::string::npos || last < begin ? wanted.size() : last;
    std::string name = wanted;
    for (int number = 2; !taken_.insert(in_lower_case(name)).second; ++number) {
      name = wanted.substr(0, dot) + " " + std::to_string(number) + wanted.substr(dot);
    }
    files_.push_back(name);
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
  const std::vector<std::vector<std::string>>& names_of_mesh_;  // of sets of texture coordinates
  std::vector<std::string> files_;                              // by image
  std::set<std::string> taken_;                                 // of these, in lower case
  std::vector<std::string> map_names_;                          // of the material
  std::map<int, std::int64_t> videos_;                          // by image
  std::vector<std::pair<TextureUse, std::int64_t>> textures_;
};

}  // namespace

std::vector<std::int64_t> add_fbx_materials(
    FbxDocument& document, const tinygltf::Model& model,
    const std::vector<std::vector<std::string>>& map_names) {
  MaterialWriter writer(document, model, map_names);
  std::vector<std::int64_t> numbers;
  numbers.reserve(model.materials.size());
  for (int material = 0; idx(material) < model.materials.size(); ++material) {
    numbers.push_back(writer.add(material));
  }
  return numbers;
}

std::int64_t add_fbx_plain_material(FbxDocument& document) {
  return document.add("Material", "material", "Material", "",
                      [](FbxRecords& records) { write_material(records, Look()); });
}

}  // namespace curveskel
