#include "rig/usd/usd_materials.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/extension_numbers.hpp"
#include "rig/gltf/texture_transform.hpp"
#include "rig/usd/usd_names.hpp"

namespace curveskel {
namespace {

using UsdColour = std::array<double, 4>;

UsdColour usd_colour(const std::vector<double>& given, const UsdColour& otherwise) {
  UsdColour colour = otherwise;
  std::copy_n(given.begin(), std::min<std::size_t>(4, given.size()), colour.begin());
  return colour;
}

std::string usd_rgb(const UsdColour& colour) {
  return usd_tuple({colour[0], colour[1], colour[2]});
}

std::string usd_rgba(const UsdColour& colour) {
  return usd_tuple({colour[0], colour[1], colour[2], colour[3]});
}

/// A picture's numbers times `scale` plus `bias`.
struct PictureUse {
  const char* name;   ///< of the shader
  const char* space;  ///< "sRGB" or "raw"
  UsdColour scale{1, 1, 1, 1};
  UsdColour bias{};
  UsdColour otherwise{0, 0, 0, 1};  ///< where the picture is not found
};

const char* wrap_name(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return "clamp";
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? "mirror" : "repeat";
}

/// Also of a texture that has its picture by an extension alone.
int picture_number(const tinygltf::Texture& texture) {
  if (texture.source >= 0) return texture.source;
  for (const char* holder : {"EXT_texture_webp", "KHR_texture_basisu"}) {
    const double image = number_in(texture.extensions, holder, "source", -1);
    if (image >= 0 && image < 1e6) return static_cast<int>(image);
  }
  return -1;
}

class UsdMaterialWriter {
 public:
  UsdMaterialWriter(UsdText& text, const tinygltf::Model& model, UsdPictures& pictures)
      : text_(text), model_(model), pictures_(pictures) {}

  /// Returns the factor of colours of vertices, where it shows some.
  UsdColour write(int number, const std::string& path) {
    const tinygltf::Material& given = model_.materials[idx(number)];
    path_ = path;
    shaders_ = UsdText(text_depth);
    readers_.clear();
    const std::string name = path.substr(path.rfind('/') + 1);
    UsdText surface(text_depth + 1);
    const UsdColour factor = write_colour(surface, given, shows_vertex_colours(number));
    write_metal(surface, given);
    write_light(surface, given);
    write_relief(surface, given);
    write_coat(surface, given);
    text_.begin("Material", name, {{}, usd_true_name(given.name, name)});
    text_.line("token outputs:surface.connect = " + usd_target(path_ + "/Surface.outputs:surface"));
    text_.begin("Shader", "Surface");
    text_.line("uniform token info:id = \"UsdPreviewSurface\"");
    text_.append(surface.text());
    text_.line("token outputs:surface");
    text_.end();
    text_.append(shaders_.text());
    text_.end();
    return factor;
  }

 private:
  static constexpr std::size_t text_depth = 3;  // of what stands in a material

  [[nodiscard]] bool shows_vertex_colours(int material) const {
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (primitive.material == material && primitive.attributes.contains("COLOR_0")) return true;
      }
    }
    return false;
  }

  void connect(UsdText& surface, const std::string& input, const std::string& output) const {
    surface.line(input + ".connect = " + usd_target(path_ + "/" + output));
  }

  UsdColour write_colour(UsdText& surface, const tinygltf::Material& given, bool shows_colours) {
    const auto& look = given.pbrMetallicRoughness;
    const UsdColour factor = usd_colour(look.baseColorFactor, {1, 1, 1, 1});
    const bool is_opaque = given.alphaMode.empty() || given.alphaMode == "OPAQUE";
    const bool has_picture =
        add_texture(look.baseColorTexture, {"Color", "sRGB", factor, {}, factor});
    const bool by_vertex = !has_picture && shows_colours;
    if (has_picture) connect(surface, "color3f inputs:diffuseColor", "Color.outputs:rgb");
    if (!has_picture) surface.line("color3f inputs:diffuseColor = " + usd_rgb(factor));
    if (by_vertex) {  // some programs know no such reader, and take the number above
      add_primvar("Vertex_colors", "float3", "displayColor", usd_rgb(factor));
      connect(surface, "color3f inputs:diffuseColor", "Vertex_colors.outputs:result");
    }
    if (is_opaque) return by_vertex ? factor : UsdColour{1, 1, 1, 1};
    if (has_picture) connect(surface, "float inputs:opacity", "Color.outputs:a");
    if (by_vertex) {
      add_primvar("Vertex_opacity", "float", "displayOpacity", usd_tuple({factor[3]}));
      connect(surface, "float inputs:opacity", "Vertex_opacity.outputs:result");
    }
    if (!has_picture && !by_vertex) {
      surface.line("float inputs:opacity = " + usd_tuple({factor[3]}));
    }
    if (given.alphaMode == "MASK") {
      surface.line("float inputs:opacityThreshold = " + usd_tuple({given.alphaCutoff}));
    }
    return by_vertex ? factor : UsdColour{1, 1, 1, 1};
  }

  void write_metal(UsdText& surface, const tinygltf::Material& given) {
    const auto& look = given.pbrMetallicRoughness;
    const UsdColour factors{1, look.roughnessFactor, look.metallicFactor, 1};
    if (add_texture(look.metallicRoughnessTexture,
                    {"Metal_roughness", "raw", factors, {}, factors})) {
      connect(surface, "float inputs:roughness", "Metal_roughness.outputs:g");
      connect(surface, "float inputs:metallic", "Metal_roughness.outputs:b");
      return;
    }
    surface.line("float inputs:roughness = " + usd_tuple({look.roughnessFactor}));
    surface.line("float inputs:metallic = " + usd_tuple({look.metallicFactor}));
  }

  void write_light(UsdText& surface, const tinygltf::Material& given) {
    UsdColour light = usd_colour(given.emissiveFactor, {0, 0, 0, 1});
    const double strength =
        number_in(given.extensions, emissive_strength_extension, "emissiveStrength", 1);
    for (std::size_t k = 0; k < 3; ++k) light[k] *= strength;
    if (light == UsdColour{0, 0, 0, 1}) return;
    if (add_texture(given.emissiveTexture, {"Emission", "sRGB", light, {}, light})) {
      connect(surface, "color3f inputs:emissiveColor", "Emission.outputs:rgb");
    } else {
      surface.line("color3f inputs:emissiveColor = " + usd_rgb(light));
    }
  }

  void write_relief(UsdText& surface, const tinygltf::Material& given) {
    const double strength = given.normalTexture.scale;
    if (add_texture(given.normalTexture, {"Normal",
                                          "raw",
                                          {2 * strength, 2 * strength, 2, 1},
                                          {-strength, -strength, -1, 0},
                                          {0, 0, 1, 1}})) {
      connect(surface, "normal3f inputs:normal", "Normal.outputs:rgb");
    }
    const double share = given.occlusionTexture.strength;
    if (add_texture(given.occlusionTexture,
                    {"Occlusion", "raw", {share, 1, 1, 1}, {1 - share, 0, 0, 0}, {1, 1, 1, 1}})) {
      connect(surface, "float inputs:occlusion", "Occlusion.outputs:r");
    }
  }

  static void write_coat(UsdText& surface, const tinygltf::Material& given) {
    constexpr const char* coat = "KHR_materials_clearcoat";
    const double share = number_in(given.extensions, coat, "clearcoatFactor", 0);
    if (share > 0) {
      surface.line("float inputs:clearcoat = " + usd_tuple({share}));
      surface.line("float inputs:clearcoatRoughness = " +
                   usd_tuple({number_in(given.extensions, coat, "clearcoatRoughnessFactor", 0)}));
    }
    const double ior = number_in(given.extensions, "KHR_materials_ior", "ior", 0);
    if (ior > 0) surface.line("float inputs:ior = " + usd_tuple({ior}));
  }

  void add_primvar(const std::string& name, const std::string& type, const std::string& primvar,
                   const std::string& otherwise) {
    shaders_.begin("Shader", name);
    shaders_.line("uniform token info:id = \"UsdPrimvarReader_" + type + "\"");
    shaders_.line("string inputs:varname = \"" + primvar + "\"");
    shaders_.line(type + " inputs:fallback = " + otherwise);
    shaders_.line(type + " outputs:result");
    shaders_.end();
  }

  /// The output that reads a set of texture coordinates.
  std::string reader_of(std::size_t map) {
    const std::string primvar = map == 0 ? "st" : "st" + std::to_string(map);
    const std::string name = "Reader_" + primvar;
    if (std::ranges::find(readers_, map) == readers_.end()) {
      readers_.push_back(map);
      add_primvar(name, "float2", primvar, "(0, 0)");
    }
    return name + ".outputs:result";
  }

  /// The output that such coordinates come from, moved as the texture says.
  std::string coordinates_of(std::size_t map, const TextureTransform& move,
                             const std::string& name) {
    std::string read = reader_of(map);
    if (move == TextureTransform()) return read;
    constexpr double degrees = 180 / std::numbers::pi;
    shaders_.begin("Shader", name + "_transform");
    shaders_.line("uniform token info:id = \"UsdTransform2d\"");
    shaders_.line("float2 inputs:in.connect = " + usd_target(path_ + "/" + read));
    shaders_.line("float inputs:rotation = " + usd_tuple({move.turn * degrees}));
    shaders_.line("float2 inputs:scale = " + usd_tuple({move.scale[0], move.scale[1]}));
    shaders_.line("float2 inputs:translation = " + usd_tuple({move.shift[0], move.shift[1]}));
    shaders_.line("float2 outputs:result");
    shaders_.end();
    return name + "_transform.outputs:result";
  }

  /// False where there is no picture.
  template <typename TextureInfo>
  bool add_texture(const TextureInfo& info, const PictureUse& use) {
    if (info.index < 0 || idx(info.index) >= model_.textures.size()) return false;
    const tinygltf::Texture& texture = model_.textures[idx(info.index)];
    const std::string picture = pictures_.path_of(picture_number(texture));
    if (picture.empty()) return false;
    const double map = number_in(info.extensions, texture_transform_extension, "texCoord",
                                 static_cast<double>(info.texCoord));
    const std::string coordinates =
        coordinates_of(map >= 0 && map < 1e3 ? static_cast<std::size_t>(map) : 0,
                       transform_in(info.extensions), use.name);
    const bool is_sampled = texture.sampler >= 0 && idx(texture.sampler) < model_.samplers.size();
    const tinygltf::Sampler sampler =
        is_sampled ? model_.samplers[idx(texture.sampler)] : tinygltf::Sampler();
    shaders_.begin("Shader", use.name);
    shaders_.line("uniform token info:id = \"UsdUVTexture\"");
    shaders_.line("asset inputs:file = @" + picture + "@");
    shaders_.line("float2 inputs:st.connect = " + usd_target(path_ + "/" + coordinates));
    shaders_.line("token inputs:wrapS = \"" + std::string(wrap_name(sampler.wrapS)) + "\"");
    shaders_.line("token inputs:wrapT = \"" + std::string(wrap_name(sampler.wrapT)) + "\"");
    shaders_.line("token inputs:sourceColorSpace = \"" + std::string(use.space) + "\"");
    if (use.scale != UsdColour{1, 1, 1, 1})
      shaders_.line("float4 inputs:scale = " + usd_rgba(use.scale));
    if (use.bias != UsdColour{}) shaders_.line("float4 inputs:bias = " + usd_rgba(use.bias));
    shaders_.line("float4 inputs:fallback = " + usd_rgba(use.otherwise));
    for (const char* output : {"float outputs:r", "float outputs:g", "float outputs:b",
                               "float outputs:a", "float3 outputs:rgb"}) {
      shaders_.line(output);
    }
    shaders_.end();
    return true;
  }

  UsdText& text_;
  const tinygltf::Model& model_;
  UsdPictures& pictures_;
  std::string path_;  // of the material
  UsdText shaders_;
  std::vector<std::size_t> readers_;  // sets of texture coordinates
};

}  // namespace

UsdMaterials write_usd_materials(UsdText& text, const tinygltf::Model& model,
                                 const std::string& root, UsdPictures& pictures) {
  UsdMaterials made;
  if (model.materials.empty()) return made;
  UsdMaterialWriter writer(text, model, pictures);
  UsdNames names;
  text.begin("Scope", "Materials");
  for (int number = 0; idx(number) < model.materials.size(); ++number) {
    const std::string name = names.free(model.materials[idx(number)].name, "material");
    std::string path = root;
    made.paths.push_back(std::move(path.append("/Materials/").append(name)));
    made.colour_factors.push_back(writer.write(number, made.paths.back()));
  }
  text.end();
  return made;
}

}  // namespace curveskel
