#include "rig/fbx/fbx_look_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/base64.hpp"
#include "rig/fbx/fbx_layers.hpp"
#include "rig/gltf/picture_places.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;
using Names = std::initializer_list<std::string_view>;

class MaterialLooks {
 public:
  MaterialLooks(const FileBytes& file, const FbxRecord& root, const FbxScene& scene,
                const FbxRecord& material, const FbxRecord& geometry)
      : file_(file), root_(root), scene_(scene), material_(material), geometry_(geometry) {}

  [[nodiscard]] DressedMaterial read() const {
    MaterialLook look;
    look.colour = colour("DiffuseColor", number("DiffuseFactor", 1));
    look.emission = colour("EmissiveColor", number("EmissiveFactor", 1));
    look.opacity = opacity();
    look.roughness = 1 - std::sqrt(std::max(shine(), 0.0)) / 10;
    if (is_blenders()) look.metalness = number("ReflectionFactor", 0);
    look.base = picture({"DiffuseColor", "Maya|baseColor", "Maya|baseColor|file",
                         "Maya|TEX_color_map", "Maya|TEX_color_map|file", "Maya|DiffuseTexture",
                         "3dsMax|Parameters|base_color_map"});
    look.normals = picture({"NormalMap", "Maya|normalCamera", "Maya|TEX_normal_map",
                            "Maya|TEX_normal_map|file", "Maya|NormalTexture"});
    if (is_blenders()) look.normal_strength = number("BumpFactor", 1);
    look.light = picture({"EmissiveColor", "Maya|emissionColor", "Maya|TEX_emissive_map",
                          "Maya|TEX_emissive_map|file", "3dsMax|Parameters|emit_color_map"});
    const auto cutout = picture({"TransparentColor", "TransparencyFactor"});
    look.base_has_alpha = look.base && cutout && cutout->is_same_picture(*look.base);
    return {fbx_name(material_), look};
  }

 private:
  static double number_in(const FbxRecord* property, double otherwise) {
    if (property == nullptr) return otherwise;
    const double value = property->number(first_property_value, otherwise);
    return std::isfinite(value) ? value : otherwise;
  }

  /// The material's own, or that of the file's template: exporters leave out what is as there.
  [[nodiscard]] double number(std::string_view name, double otherwise) const {
    return number_in(scene_.property(material_, name), otherwise);
  }

  /// Programs write one of the two, or both; the template has a default for either.
  [[nodiscard]] double shine() const {
    for (const char* name : {"Shininess", "ShininessExponent"}) {
      if (const FbxRecord* own = fbx_property(&material_, name)) return number_in(own, 0);
    }
    return number("Shininess", number("ShininessExponent", 0));
  }

  [[nodiscard]] std::optional<std::array<double, 3>> colour(std::string_view name,
                                                            double factor) const {
    const FbxRecord* found = scene_.property(material_, name);
    if (found == nullptr) return std::nullopt;
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = factor * found->number(first_property_value + k, 0);
      if (!std::isfinite(result[k])) return std::nullopt;
    }
    return result;
  }

  /// Nobody has a material that is not seen at all: exporters that say so mean that it is.
  /// Templates are opaque in three ways, of which a material may contradict any, so they are left.
  [[nodiscard]] double opacity() const {
    double result = number_in(fbx_property(&material_, "Opacity"), -1);
    if (result < 0) {
      const FbxRecord* given = fbx_property(&material_, "TransparencyFactor");
      const double factor = number_in(given, 0);
      const bool is_coloured = fbx_property(&material_, "TransparentColor") != nullptr;
      const auto through =
          is_coloured ? colour("TransparentColor", given == nullptr ? 1 : factor) : std::nullopt;
      result = 1 - (through ? ((*through)[0] + (*through)[1] + (*through)[2]) / 3 : factor);
    }
    return result > 0 ? std::min(result, 1.0) : 1;
  }

  /// Elsewhere ReflectionFactor says how mirror-like a phong material is, and BumpFactor how high
  /// its bumps are.
  [[nodiscard]] bool is_blenders() const {
    const FbxRecord* header = root_.child("FBXHeaderExtension");
    const FbxRecord* creator = header == nullptr ? nullptr : header->child("Creator");
    if (creator == nullptr) return false;
    const std::string_view text = creator->text(0);
    return text.starts_with("Blender") || text.starts_with("curveskel");
  }

  [[nodiscard]] std::optional<DressedPicture> picture(Names properties) const {
    for (const std::string_view property : properties) {
      const FbxRecord* texture = scene_.at_property(material_, property, "Texture");
      if (texture != nullptr) return picture_of(*texture);
    }
    return std::nullopt;
  }

  [[nodiscard]] DressedPicture picture_of(const FbxRecord& texture) const {
    const auto videos = scene_.below(texture, "Video");
    const FbxRecord& named = videos.empty() ? texture : *videos.front();
    DressedPicture result;
    result.name = file_named(named);
    if (result.name.empty()) result.name = file_named(texture);
    const FbxRecord* content = named.child("Content");
    if (content != nullptr) result.bytes = bytes_of(*content);
    result.path = result.bytes.empty()
                      ? picture_place(file_.path, file_.path.parent_path(), result.name)
                      : fs::path(result.name);
    result.set = set_of(texture);
    result.transform = transform_of(texture);
    return result;
  }

  /// Blender writes the inverse of the scale, and radians to the other side.
  [[nodiscard]] TextureTransform transform_of(const FbxRecord& texture) const {
    const FbxRecord* scale = scene_.property(texture, "Scaling");
    const FbxRecord* turn = scene_.property(texture, "Rotation");
    const FbxRecord* shift = scene_.property(texture, "Translation");
    const auto at = [](const FbxRecord* property, std::size_t k, double otherwise) {
      if (property == nullptr) return otherwise;
      const double value = property->number(first_property_value + k, otherwise);
      return std::isfinite(value) ? value : otherwise;
    };
    TextureTransform result;
    for (std::size_t k = 0; k < 2; ++k) {
      const double given = at(scale, k, 1);
      if (given != 0) result.scale[k] = is_blenders() ? 1 / given : given;
      result.shift[k] = at(shift, k, 0);
    }
    const double angle = at(turn, 2, 0);
    if (angle != 0) result.turn = is_blenders() ? -angle : angle * std::numbers::pi / 180;
    return result;
  }

  /// The set that the texture names; the first where it names none that is there.
  [[nodiscard]] std::size_t set_of(const FbxRecord& texture) const {
    const FbxRecord* named = fbx_property(&texture, "UVSet");
    if (named == nullptr) return 0;
    const std::vector<const FbxRecord*> sets = fbx_sets(geometry_, "LayerElementUV");
    for (std::size_t set = 0; set < sets.size(); ++set) {
      const FbxRecord* name = sets[set]->child("Name");
      if (name != nullptr && name->text(0) == named->text(first_property_value)) return set;
    }
    return 0;
  }

  /// With the separators of this system.
  static std::string file_named(const FbxRecord& object) {
    for (const std::string_view key : {"RelativeFilename", "FileName", "Filename"}) {
      const FbxRecord* child = object.child(key);
      if (child == nullptr || child->text(0).empty()) continue;
      std::string name(child->text(0));
      std::replace(name.begin(), name.end(), '\\', '/');
      return name;
    }
    return "";
  }

  /// In text files as base64, in pieces.
  [[nodiscard]] std::string bytes_of(const FbxRecord& content) const {
    if (is_binary_fbx(file_)) return std::string(content.text(0));
    std::string bytes;
    for (std::size_t k = 0; k < content.values.size(); ++k) {
      std::string_view text = content.text(k);
      append_from_base64(bytes, text, bytes.size() + text.size());
    }
    return bytes;
  }

  const FileBytes& file_;
  const FbxRecord& root_;
  const FbxScene& scene_;
  const FbxRecord& material_;
  const FbxRecord& geometry_;
};

}  // namespace

DressedMaterial fbx_look_of(const FileBytes& file, const FbxRecord& root, const FbxScene& scene,
                            const FbxRecord& material, const FbxRecord& geometry) {
  return MaterialLooks(file, root, scene, material, geometry).read();
}

}  // namespace curveskel
