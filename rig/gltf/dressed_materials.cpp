#include "rig/gltf/dressed_materials.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/utf8.hpp"
#include "rig/gltf/gltf_pictures.hpp"
#include "rig/gltf/picture_as_png.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

/// Pictures of a document, each once. Those that are given must outlive this.
class Pictures {
 public:
  Pictures(GltfDocument& document, std::vector<std::string>& notes, const Monitor& monitor)
      : document_(document), notes_(notes), monitor_(monitor) {}

  /// Its texture; nothing where it cannot be had.
  std::optional<std::size_t> texture(const DressedPicture& picture) {
    const auto [entry, is_new] = textures_.try_emplace({picture.path, picture.bytes});
    if (is_new) entry->second = add(picture);
    return entry->second;
  }

 private:
  std::optional<std::size_t> add(const DressedPicture& picture) {
    std::error_code ignored;
    const bool is_within = !picture.bytes.empty();
    const bool is_there = is_within || fs::is_regular_file(picture.path, ignored);
    std::string bytes = is_within  ? picture.bytes
                        : is_there ? read_file(picture.path, monitor_, "a picture").content
                                   : "";
    auto type = picture_type(bytes);
    if (!type && is_there) {
      if (auto png = picture_as_png(bytes)) {
        bytes = std::move(*png);
        type = "image/png";
      }
    }
    if (type != "image/png" && type != "image/jpeg") {
      notes_.push_back("the picture " + in_quotes(picture.name) +
                       (is_there
                            ? " is none that glTF has, or that can be made one: PNG, JPEG, TGA, "
                              "BMP, GIF or PSD; convert it"
                            : " is missing"));
      return std::nullopt;
    }
    const std::size_t view = add_view(document_, bytes);
    OrderedJson& images = array_in(document_.json, "images");
    images.push_back({{"name", as_utf8(picture.path.stem().string())},
                      {"mimeType", *type},
                      {"bufferView", view}});
    const std::size_t source = images.size() - 1;
    // A new list moves those that are there.
    OrderedJson& textures = array_in(document_.json, "textures");
    textures.push_back({{"source", source}});
    return textures.size() - 1;
  }

  GltfDocument& document_;
  std::vector<std::string>& notes_;
  const Monitor& monitor_;
  // By path and the bytes that the file has within it, which stay there: two folders may have
  // pictures of one name.
  std::map<std::pair<fs::path, std::string_view>, std::optional<std::size_t>> textures_;
};

/// Materials of a document, and the extensions that they need.
class Materials {
 public:
  explicit Materials(Pictures pictures) : pictures_(std::move(pictures)) {}

  OrderedJson made(const std::string& name, const MaterialLook& given) {
    OrderedJson result{{"name", as_utf8(name)}};
    OrderedJson& look = result["pbrMetallicRoughness"];
    const auto base = texture(given.base);
    std::array<double, 3> colour = given.colour.value_or(std::array<double, 3>{1, 1, 1});
    if (base) colour = {1, 1, 1};  // the texture is the colour
    const double opacity = std::clamp(given.opacity, 0.0, 1.0);
    look["baseColorFactor"] = {std::clamp(colour[0], 0.0, 1.0), std::clamp(colour[1], 0.0, 1.0),
                               std::clamp(colour[2], 0.0, 1.0), opacity};
    if (base) look["baseColorTexture"] = *base;
    look["metallicFactor"] = std::clamp(given.metalness, 0.0, 1.0);
    look["roughnessFactor"] = std::clamp(given.roughness, 0.0, 1.0);
    if (const auto normals = texture(given.normals)) {
      result["normalTexture"] = *normals;
      if (given.normal_strength != 1) result["normalTexture"]["scale"] = given.normal_strength;
    }
    add_emission(result, given.emission, texture(given.light));
    if (opacity < 1 || (base && given.base_has_alpha)) result["alphaMode"] = "BLEND";
    if (given.two_sided) result["doubleSided"] = true;
    return result;
  }

  [[nodiscard]] const std::set<std::string>& extensions() const { return extensions_; }

 private:
  std::optional<OrderedJson> texture(const std::optional<DressedPicture>& picture) {
    if (!picture) return std::nullopt;
    const auto index = pictures_.texture(*picture);
    if (!index) return std::nullopt;
    OrderedJson reference = OrderedJson::object();
    reference["index"] = *index;
    if (picture->set > 0) reference["texCoord"] = picture->set;
    if (picture->transform == TextureTransform()) return reference;
    const TextureTransform there = flipped(picture->transform);
    OrderedJson& written = reference["extensions"][texture_transform_extension];
    written["offset"] = there.shift;
    if (there.turn != 0) written["rotation"] = -there.turn;
    written["scale"] = there.scale;
    extensions_.insert(texture_transform_extension);
    return reference;
  }

  /// A texture is lit in full where the material says no colour, or black, as many programs write.
  /// Of a brighter light than glTF's colours have, the hue stays.
  void add_emission(OrderedJson& result, const std::optional<std::array<double, 3>>& colour,
                    const std::optional<OrderedJson>& texture) {
    constexpr std::array<double, 3> black{0, 0, 0};
    const bool is_lit = colour && *colour != black;
    if (texture) result["emissiveTexture"] = *texture;
    if (!texture && !is_lit) return;
    const std::array<double, 3> light = is_lit ? *colour : std::array<double, 3>{1, 1, 1};
    const double strength = std::max(1.0, *std::max_element(light.begin(), light.end()));
    for (const double part : light) {
      result["emissiveFactor"].push_back(std::clamp(part / strength, 0.0, 1.0));
    }
    if (strength == 1) return;
    result["extensions"][emissive_strength_extension]["emissiveStrength"] = strength;
    extensions_.insert(emissive_strength_extension);
  }

  Pictures pictures_;
  std::set<std::string> extensions_;
};

}  // namespace

void add_materials(GltfDocument& document, const std::vector<DressedMaterial>& materials,
                   std::vector<std::string>& notes, const Monitor& monitor) {
  Materials writer(Pictures(document, notes, monitor));
  for (const DressedMaterial& material : materials) {
    OrderedJson made = material.look ? writer.made(material.name, *material.look)
                                     : OrderedJson{{"name", as_utf8(material.name)}};
    array_in(document.json, "materials").push_back(std::move(made));
  }
  for (const std::string& extension : writer.extensions()) {
    array_in(document.json, "extensionsUsed").push_back(extension);
  }
}

}  // namespace curveskel
