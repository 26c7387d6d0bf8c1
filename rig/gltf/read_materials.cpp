#include <curveskel/read_materials.hpp>

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/rig_files.hpp>
#include "base/base64.hpp"
#include "rig/gltf/dressed_document.hpp"
#include "rig/gltf/dressed_file.hpp"
#include "rig/gltf/gltf_document.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/gltf_file.hpp"
#include "surface/read/gltf_numbers.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {
namespace {

constexpr const char* transform_extension = "KHR_texture_transform";

/// The place of a picture on a material.
struct TextureUse {
  int coordinates = 0;  // set of texture coordinates
  Eigen::Affine2f place = Eigen::Affine2f::Identity();
};

Eigen::Vector2f two_numbers(const tinygltf::Value& value, const char* name, float otherwise) {
  Eigen::Vector2f result(otherwise, otherwise);
  if (!value.Has(name) || value.Get(name).ArrayLen() != 2) return result;
  for (int k = 0; k < 2; ++k) {
    result[k] = static_cast<float>(value.Get(name).Get(k).GetNumberAsDouble());
  }
  return result;
}

TextureUse texture_use(const tinygltf::TextureInfo& texture) {
  TextureUse use;
  use.coordinates = texture.texCoord;
  const auto found = texture.extensions.find(transform_extension);
  if (found == texture.extensions.end()) return use;
  const tinygltf::Value& moved = found->second;
  const float turn =
      moved.Has("rotation") ? static_cast<float>(moved.Get("rotation").GetNumberAsDouble()) : 0;
  use.place.translate(two_numbers(moved, "offset", 0));
  use.place.rotate(Eigen::Rotation2Df(-turn));
  use.place.scale(two_numbers(moved, "scale", 1));
  if (moved.Has("texCoord")) use.coordinates = moved.Get("texCoord").GetNumberAsInt();
  return use;
}

/// Of files from before glTF had one way to say it.
constexpr const char* older_extension = "KHR_materials_pbrSpecularGlossiness";

const tinygltf::Value* older_look(const tinygltf::Material& material) {
  const auto found = material.extensions.find(older_extension);
  return found == material.extensions.end() ? nullptr : &found->second;
}

std::vector<double> base_colour(const tinygltf::Material& material) {
  const tinygltf::Value* older = older_look(material);
  if (older == nullptr) return material.pbrMetallicRoughness.baseColorFactor;
  std::vector<double> factor;
  if (!older->Has("diffuseFactor")) return factor;
  const tinygltf::Value& given = older->Get("diffuseFactor");
  for (std::size_t k = 0; k < given.ArrayLen(); ++k) {
    factor.push_back(given.Get(static_cast<int>(k)).GetNumberAsDouble());
  }
  return factor;
}

tinygltf::TextureInfo base_texture(const tinygltf::Material& material) {
  const tinygltf::Value* older = older_look(material);
  if (older == nullptr) return material.pbrMetallicRoughness.baseColorTexture;
  tinygltf::TextureInfo texture;
  if (!older->Has("diffuseTexture")) return texture;
  const tinygltf::Value& given = older->Get("diffuseTexture");
  if (given.Has("index")) texture.index = given.Get("index").GetNumberAsInt();
  if (given.Has("texCoord")) texture.texCoord = given.Get("texCoord").GetNumberAsInt();
  return texture;
}

/// The parts of a file that hold its look.
class MaterialReader {
 public:
  MaterialReader(const FileBytes& file, const tinygltf::Model& model, const GltfDocument& document)
      : file_(file), model_(model), document_(document) {}

  SurfaceMaterials read(const GltfScene& scene) {
    for (const tinygltf::Material& material : model_.materials) add_material(material);
    for (const GltfPart& part : scene.parts) {
      if (part.in_soup) add_part(part, scene.soup);
    }
    return finish();
  }

 private:
  void add_material(const tinygltf::Material& given) {
    SurfaceMaterial material;
    const auto factor = base_colour(given);
    for (std::size_t k = 0; k < 4 && k < factor.size(); ++k) {
      material.colour[k] = static_cast<float>(factor[k]);
    }
    material.is_cut_out = given.alphaMode != "OPAQUE" && !given.alphaMode.empty();
    const tinygltf::TextureInfo texture = base_texture(given);
    uses_.push_back(texture_use(texture));
    if (texture.index >= 0 && idx(texture.index) < model_.textures.size()) {
      const tinygltf::Texture& used = model_.textures[idx(texture.index)];
      material.picture = picture_of(used);
      if (used.sampler >= 0 && idx(used.sampler) < model_.samplers.size()) {
        const tinygltf::Sampler& sampler = model_.samplers[idx(used.sampler)];
        material.repeats = {sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE,
                            sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE};
      }
    }
    made_.materials.push_back(material);
  }

  /// The picture's number in the result, the same for all that show it, or -1.
  int picture_of(const tinygltf::Texture& texture) {
    int source = texture.source;
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (source < 0 && webp != texture.extensions.end() && webp->second.Has("source")) {
      source = webp->second.Get("source").GetNumberAsInt();
    }
    const OrderedJson& images = listed("images");
    if (source < 0 || idx(source) >= images.size()) return -1;
    const auto [known, is_new] = picture_of_image_.try_emplace(source, -1);
    if (!is_new) return known->second;
    std::string bytes = picture_bytes(images[idx(source)]);
    if (bytes.empty()) return -1;
    known->second = static_cast<int>(made_.pictures.size());
    made_.pictures.push_back({std::move(bytes)});
    return known->second;
  }

  /// The document's list of this name, which may have whole pictures in it.
  [[nodiscard]] const OrderedJson& listed(const char* name) const {
    static const OrderedJson none = OrderedJson::array();
    const auto found = document_.json.find(name);
    return found == document_.json.end() ? none : *found;
  }

  [[nodiscard]] std::string picture_bytes(const OrderedJson& image) const {
    const std::string uri = image.value("uri", "");
    const std::size_t comma = uri.find(";base64,");
    if (uri.starts_with("data:") && comma != std::string::npos) {
      std::string bytes;
      std::string_view digits = std::string_view(uri).substr(comma + 8);
      append_from_base64(bytes, digits, std::numeric_limits<std::size_t>::max());
      return bytes;
    }
    const OrderedJson& views = listed("bufferViews");
    const auto view = image.value("bufferView", views.size());
    if (view >= views.size()) return {};
    const auto from = views[view].value("byteOffset", std::size_t{0});
    const auto size = views[view].value("byteLength", std::size_t{0});
    const std::string& numbers = document_.numbers;
    if (from > numbers.size() || size > numbers.size() - from) return {};
    return numbers.substr(from, size);
  }

  void add_part(const GltfPart& part, const PolygonSoup& soup) {
    const tinygltf::Primitive& primitive =
        model_.meshes[idx(part.mesh)].primitives[idx(part.primitive)];
    const auto first = static_cast<int>(made_.vertices.size());
    const auto rows = static_cast<std::size_t>(part.count);
    for (std::size_t row = 0; row < rows; ++row) {
      made_.vertices.push_back(static_cast<int>(part.first_vertex) + static_cast<int>(row));
    }
    const bool is_known = primitive.material >= 0 && idx(primitive.material) < uses_.size();
    add_places(primitive, rows, is_known ? uses_[idx(primitive.material)] : TextureUse{});
    add_colours(primitive, rows);
    const std::size_t corners =
        primitive.indices >= 0 ? model_.accessors[idx(primitive.indices)].count : rows;
    const std::size_t faces = gltf_triangle_count(primitive.mode, corners);
    for (std::size_t corner = 0; corner < 3 * faces; ++corner) {
      const std::int32_t vertex = soup.corners[3 * next_face_ + corner];
      corners_.push_back(first + vertex - static_cast<int>(part.first_vertex));
    }
    next_face_ += faces;
    made_.material.insert(made_.material.end(), faces, is_known ? primitive.material : -1);
  }

  void add_places(const tinygltf::Primitive& primitive, std::size_t rows, const TextureUse& use) {
    const auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(use.coordinates));
    if (found == primitive.attributes.end()) {
      places_.resize(places_.size() + rows, Eigen::Vector2f::Zero());
      return;
    }
    const GltfNumbers numbers =
        gltf_numbers(file_, model_, found->second, 2, "texture coordinates");
    for (std::size_t row = 0; row < rows; ++row) {
      Eigen::Vector2f place = Eigen::Vector2f::Zero();
      for (std::size_t k = 0; k < 2 && row < numbers.rows(); ++k) {
        place[static_cast<Eigen::Index>(k)] = static_cast<float>(numbers.at(row, k));
      }
      places_.emplace_back(use.place * place);
    }
  }

  void add_colours(const tinygltf::Primitive& primitive, std::size_t rows) {
    const auto found = primitive.attributes.find("COLOR_0");
    const bool has = found != primitive.attributes.end();
    has_colours_ = has_colours_ || has;
    if (!has) {
      colours_.resize(colours_.size() + rows, Eigen::Vector4f::Ones());
      return;
    }
    const tinygltf::Accessor& accessor =
        gltf_element(file_, model_.accessors, found->second, "accessor");
    const int components = accessor.type == TINYGLTF_TYPE_VEC3 ? 3 : 4;
    const GltfNumbers numbers = gltf_numbers(file_, model_, found->second, components, "colours");
    for (std::size_t row = 0; row < rows; ++row) {
      Eigen::Vector4f colour = Eigen::Vector4f::Ones();
      for (int k = 0; k < components && row < numbers.rows(); ++k) {
        colour[k] = static_cast<float>(numbers.at(row, idx(k)));
      }
      colours_.push_back(colour);
    }
  }

  SurfaceMaterials finish() {
    const auto rows = static_cast<Eigen::Index>(places_.size());
    made_.places_in_picture.resize(rows, 2);
    made_.colours.resize(rows, 4);
    for (Eigen::Index row = 0; row < rows; ++row) {
      made_.places_in_picture.row(row) = places_[idx(row)].transpose();
      made_.colours.row(row) = colours_[idx(row)].transpose();
    }
    made_.triangles.resize(static_cast<Eigen::Index>(corners_.size() / 3), 3);
    std::copy(corners_.begin(), corners_.end(), made_.triangles.data());
    if (made_.materials.empty() && !has_colours_) made_.triangles.resize(0, 3);
    return std::move(made_);
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  const GltfDocument& document_;
  std::vector<TextureUse> uses_;         // by material
  std::map<int, int> picture_of_image_;  // those that materials have named; -1 = has no bytes
  std::vector<Eigen::Vector2f> places_;
  std::vector<Eigen::Vector4f> colours_;
  std::vector<int> corners_;
  std::size_t next_face_ = 0;  // of the soup
  bool has_colours_ = false;
  SurfaceMaterials made_;
};

std::optional<SurfaceMaterials> materials_in(const FileBytes& file, const GltfDocument& document,
                                             const tinygltf::Model& model, const Monitor& monitor) {
  const GltfScene scene = read_gltf_scene(file, model, monitor);
  SurfaceMaterials made = MaterialReader(file, model, document).read(scene);
  if (made.triangles.rows() == 0) return std::nullopt;
  return made;
}

}  // namespace

std::optional<SurfaceMaterials> read_materials(const std::filesystem::path& path,
                                               const Monitor& monitor) {
  const FileBytes file = read_file(path, monitor);
  const auto format = surface_format_of(file);
  std::vector<std::string> notes;
  if (format == SurfaceFormat::glb || format == SurfaceFormat::gltf) {
    const tinygltf::Model model = parse_gltf(file, monitor, GltfAttributes::all);
    return materials_in(file, read_gltf_document(file, model, notes, monitor), model, monitor);
  }
  const auto dressed = read_dressed_file(file, {}, notes, monitor);
  if (!dressed || dressed->materials.empty()) return std::nullopt;
  DressedDocument made =
      dressed_document(dressed->mesh, dressed->materials, file, "surface", notes, monitor);
  FileBytes inside{file.path, format_gltf(made.document, RigFormat::glb)};
  const tinygltf::Model model = parse_gltf(inside, monitor, GltfAttributes::all);
  auto materials = materials_in(inside, made.document, model, monitor);
  if (materials) {
    for (int& vertex : materials->vertices) vertex = made.row_of_vertex[idx(vertex)];
  }
  return materials;
}

}  // namespace curveskel
