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

#include <curveskel/advanced/file_names.hpp>
#include "rig/gltf/gltf_pictures.hpp"
#include "rig/gltf/picture_places.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

struct MtlPicture {
  fs::path library;
  std::string name;
  TextureTransform transform;
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

/// Leaves out what is no finite number.
std::array<double, 2> first_two(std::istringstream numbers, std::array<double, 2> otherwise) {
  for (double& one : otherwise) {
    double given = 0;
    if (!(numbers >> given) || !std::isfinite(given)) break;
    one = given;
  }
  return otherwise;
}

/// Options such as "-s 2 2 1", of which the scale and the shift count, and the name behind them,
/// with the separators of this system.
MtlPicture picture_of(const fs::path& library, std::string text) {
  const auto is_value = [](const std::string& word) {
    return word == "on" || word == "off" ||
           word.find_first_not_of("+-.0123456789eE") == std::string::npos;
  };
  MtlPicture picture{library, "", {}};
  while (text.starts_with('-')) {
    std::istringstream words(text);
    std::string option;
    words >> option;
    if (option == "-s")
      picture.transform.scale = first_two(std::istringstream(text.substr(2)), {1, 1});
    if (option == "-o")
      picture.transform.shift = first_two(std::istringstream(text.substr(2)), {0, 0});
    const bool has_word = option == "-imfchan" || option == "-type";
    std::streamoff end = words.tellg();
    std::string word;
    for (bool first = true; words >> word && (is_value(word) || (first && has_word));
         first = false) {
      end = words.tellg();
    }
    if (end < 0) return picture;
    text = trimmed(text.substr(static_cast<std::size_t>(end)));
  }
  std::replace(text.begin(), text.end(), '\\', '/');
  picture.name = text;
  return picture;
}

void read_line(const std::string& key, const std::string& rest, const fs::path& library,
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
    const MtlPicture picture = picture_of(library, rest);
    const bool is_none = picture.name.empty() || picture.name == ".";  // as Blender writes
    if (!is_none) material.pictures[key] = picture;
  }
}

void read_library(const fs::path& path, MtlLibrary& library, const Monitor& monitor) {
  std::istringstream lines(read_file(path, monitor, "materials").content);
  MtlMaterial* material = nullptr;
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    const std::string key = in_lower_case(line.substr(0, end));
    const std::string rest = trimmed(line.substr(end));
    if (key == "newmtl") {
      material = &library[rest];
    } else if (material != nullptr && !key.empty()) {
      read_line(key, rest, path, *material);
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

double roughness_of(const MtlMaterial& material) {
  constexpr double shiniest = 1000;  // of Ns
  if (material.roughness) return *material.roughness;
  const double shine = std::clamp(material.shininess.value_or(0) / shiniest, 0.0, 1.0);
  return 1 - std::sqrt(shine);
}

MaterialLook look_of(const MtlMaterial& material) {
  MaterialLook look;
  look.colour = material.colour;
  look.emission = material.emission;
  look.opacity = material.opacity;
  look.roughness = roughness_of(material);
  look.metalness = material.metalness.value_or(0);
  const auto picture = [&](const char* key) -> std::optional<DressedPicture> {
    const auto named = material.pictures.find(key);
    if (named == material.pictures.end()) return std::nullopt;
    const auto& [library, name, transform] = named->second;
    return DressedPicture{
        picture_place(library, library.parent_path(), name), name, {}, 0, transform};
  };
  look.base = picture("map_kd");
  look.normals = picture("norm");
  look.light = picture("map_ke");
  const auto cutout = material.pictures.find("map_d");
  look.base_has_alpha =
      look.base && cutout != material.pictures.end() && cutout->second.name == look.base->name;
  return look;
}

}  // namespace

std::vector<DressedMaterial> read_obj_materials(const ObjFile& obj, const FileBytes& file,
                                                std::vector<std::string>& notes,
                                                const Monitor& monitor) {
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
  std::vector<DressedMaterial> materials;
  for (const std::string& name : obj.mesh.materials) {
    const auto known = library.find(name);
    if (known == library.end() && !library.empty()) {
      notes.push_back("the material " + in_quotes(name) + " is in no library");
    }
    materials.push_back({name, {}});
    if (known != library.end()) materials.back().look = look_of(known->second);
  }
  return materials;
}

}  // namespace curveskel
