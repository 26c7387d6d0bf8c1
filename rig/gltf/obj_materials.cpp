#include "rig/gltf/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "rig/gltf/gltf_pictures.hpp"
#include "rig/gltf/skin_numbers.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

struct MtlPicture {
  fs::path folder;  ///< of the library
  std::string name;
};

struct MtlMaterial {
  std::optional<std::array<double, 3>> colour;
  std::optional<std::array<double, 3>> emission;
  double opacity = 1;
  std::optional<double> shininess;
  std::optional<double> roughness;
  std::optional<double> metalness;
  std::map<std::string, MtlPicture> pictures;  ///< by keyword in lower case
};

using MtlLibrary = std::map<std::string, MtlMaterial>;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// The name behind options such as "-s 1 1 1", with the separators of this system.
std::string picture_name(std::string text) {
  const auto is_value = [](const std::string& word) {
    return word == "on" || word == "off" ||
           word.find_first_not_of("+-.0123456789eE") == std::string::npos;
  };
  while (text.starts_with('-')) {
    std::istringstream words(text);
    std::string word;
    words >> word;
    const bool has_word = word == "-imfchan" || word == "-type";
    std::streamoff end = words.tellg();
    for (bool first = true; words >> word && (is_value(word) || (first && has_word));
         first = false) {
      end = words.tellg();
    }
    if (end < 0) return "";
    text = trimmed(text.substr(static_cast<std::size_t>(end)));
  }
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

void read_line(const std::string& key, const std::string& rest, const fs::path& folder,
               MtlMaterial& material) {
  std::istringstream numbers(rest);
  std::array<double, 3> three{};
  const bool is_number = static_cast<bool>(numbers >> three[0]) && std::isfinite(three[0]);
  if (is_number && !(numbers >> three[1] >> three[2])) three[1] = three[2] = three[0];
  if (key == "kd" && is_number) material.colour = three;
  if (key == "ke" && is_number) material.emission = three;
  if (key == "d" && is_number) material.opacity = three[0];
  if (key == "tr" && is_number) material.opacity = 1 - three[0];
  if (key == "ns" && is_number) material.shininess = three[0];
  if (key == "pr" && is_number) material.roughness = three[0];
  if (key == "pm" && is_number) material.metalness = three[0];
  if (key.starts_with("map_") || key == "norm") {
    material.pictures[key] = {folder, picture_name(rest)};
  }
}

void read_library(const fs::path& path, MtlLibrary& library, const Monitor& monitor) {
  std::istringstream lines(read_file(path, monitor).content);
  MtlMaterial* material = nullptr;
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string key = lower(line.substr(0, end));
    const std::string rest = trimmed(line.substr(end));
    if (key == "newmtl") {
      material = &library[rest];
    } else if (material != nullptr && !key.empty()) {
      read_line(key, rest, path.parent_path(), *material);
    }
  }
}

/// Several names, where there are files of all, else one name with blanks in it.
std::vector<fs::path> library_files(const fs::path& folder, const std::string& named) {
  std::vector<fs::path> files;
  std::istringstream words(named);
  std::error_code ignored;
  for (std::string word; words >> word;) {
    if (!fs::is_regular_file(folder / word, ignored)) return {folder / named};
    files.push_back(folder / word);
  }
  return files;
}

/// Pictures of a document, each once.
class Pictures {
 public:
  Pictures(GltfDocument& document, std::vector<std::string>& notes, const Monitor& monitor)
      : document_(document), notes_(notes), monitor_(monitor) {}

  /// Its texture; nothing where it cannot be had.
  std::optional<std::size_t> texture(const MtlPicture& picture) {
    const fs::path path = found(picture);
    const auto [entry, is_new] = textures_.try_emplace(path);
    if (is_new) entry->second = add(path, picture.name);
    return entry->second;
  }

 private:
  /// As named, else beside the library, as paths of another machine lead nowhere.
  [[nodiscard]] static fs::path found(const MtlPicture& picture) {
    std::error_code ignored;
    const fs::path path = picture.folder / picture.name;
    return fs::is_regular_file(path, ignored) ? path
                                              : picture.folder / fs::path(picture.name).filename();
  }

  std::optional<std::size_t> add(const fs::path& path, const std::string& name) {
    std::error_code ignored;
    const bool is_there = fs::is_regular_file(path, ignored);
    const std::string bytes = is_there ? read_file(path, monitor_).content : "";
    const auto type = picture_type(bytes);
    if (type != "image/png" && type != "image/jpeg") {
      notes_.push_back(
          "the picture " + in_quotes(name) +
          (is_there ? " is no PNG or JPEG, the kinds that glTF has; convert it" : " is missing"));
      return std::nullopt;
    }
    const std::size_t view = add_view(document_, bytes);
    OrderedJson& images = array_in(document_.json, "images");
    images.push_back(
        {{"name", as_utf8(path.stem().string())}, {"mimeType", *type}, {"bufferView", view}});
    OrderedJson& textures = array_in(document_.json, "textures");
    textures.push_back({{"source", images.size() - 1}});
    return textures.size() - 1;
  }

  GltfDocument& document_;
  std::vector<std::string>& notes_;
  const Monitor& monitor_;
  std::map<fs::path, std::optional<std::size_t>> textures_;
};

double roughness_of(const MtlMaterial& material) {
  constexpr double shiniest = 1000;  // of Ns
  if (material.roughness) return std::clamp(*material.roughness, 0.0, 1.0);
  const double shine = std::clamp(material.shininess.value_or(0) / shiniest, 0.0, 1.0);
  return 1 - std::sqrt(shine);
}

/// A texture is lit in full where the material says no colour, or black, as many programs write.
void add_emission(OrderedJson& result, const std::optional<std::array<double, 3>>& colour,
                  const std::optional<OrderedJson>& texture) {
  constexpr std::array<double, 3> black{0, 0, 0};
  const bool is_lit = colour && *colour != black;
  if (texture) result["emissiveTexture"] = *texture;
  if (!texture && !is_lit) return;
  for (const double part : is_lit ? *colour : std::array<double, 3>{1, 1, 1}) {
    result["emissiveFactor"].push_back(std::clamp(part, 0.0, 1.0));
  }
}

OrderedJson gltf_material(const std::string& name, const MtlMaterial& material,
                          Pictures& pictures) {
  OrderedJson result{{"name", as_utf8(name)}};
  const auto texture = [&](const char* key) -> std::optional<OrderedJson> {
    const auto picture = material.pictures.find(key);
    if (picture == material.pictures.end()) return std::nullopt;
    const auto index = pictures.texture(picture->second);
    if (!index) return std::nullopt;
    OrderedJson reference = OrderedJson::object();
    reference["index"] = *index;
    return reference;
  };
  OrderedJson& look = result["pbrMetallicRoughness"];
  const auto base = texture("map_kd");
  std::array<double, 3> colour = material.colour.value_or(std::array<double, 3>{1, 1, 1});
  if (base) colour = {1, 1, 1};  // the texture is the colour
  const double opacity = std::clamp(material.opacity, 0.0, 1.0);
  look["baseColorFactor"] = {std::clamp(colour[0], 0.0, 1.0), std::clamp(colour[1], 0.0, 1.0),
                             std::clamp(colour[2], 0.0, 1.0), opacity};
  if (base) look["baseColorTexture"] = *base;
  look["metallicFactor"] = std::clamp(material.metalness.value_or(0), 0.0, 1.0);
  look["roughnessFactor"] = roughness_of(material);
  if (const auto normals = texture("norm")) result["normalTexture"] = *normals;
  add_emission(result, material.emission, texture("map_ke"));
  const auto cutout = material.pictures.find("map_d");
  const bool has_alpha = base && cutout != material.pictures.end() &&
                         cutout->second.name == material.pictures.at("map_kd").name;
  if (opacity < 1 || has_alpha) result["alphaMode"] = "BLEND";
  return result;
}

}  // namespace

void add_obj_materials(GltfDocument& document, const ObjFile& obj, const FileBytes& file,
                       std::vector<std::string>& notes, const Monitor& monitor) {
  MtlLibrary library;
  for (const std::string& named : obj.libraries) {
    for (const fs::path& path : library_files(file.path.parent_path(), named)) {
      std::error_code ignored;
      if (fs::is_regular_file(path, ignored)) {
        read_library(path, library, monitor);
      } else {
        notes.push_back("the materials " + in_quotes(path.filename().string()) + " are missing");
      }
    }
  }
  Pictures pictures(document, notes, monitor);
  for (const std::string& name : obj.materials) {
    const auto found = library.find(name);
    if (found == library.end() && !library.empty()) {
      notes.push_back("the material " + in_quotes(name) + " is in no library");
    }
    OrderedJson material = found == library.end() ? OrderedJson{{"name", as_utf8(name)}}
                                                  : gltf_material(name, found->second, pictures);
    array_in(document.json, "materials").push_back(std::move(material));
  }
}

}  // namespace curveskel
