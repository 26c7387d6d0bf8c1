#include "surface/read/gltf_file.hpp"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <curveskel/advanced/file_names.hpp>
#include "base/json_depth.hpp"
#include "surface/read/gltf_compression.hpp"

namespace curveskel {
namespace {

/// The data that tinygltf hands to the callbacks below.
struct FileAccess {
  const FileBytes& file;
  const Monitor& monitor;
};

/// Pictures are reported missing, which tinygltf takes as a warning: they carry no geometry.
bool buffer_exists(const std::string& path, void* /*access*/) {
  const std::string extension = lower_extension(path);
  constexpr std::array<std::string_view, 6> pictures{"png", "jpg", "jpeg", "webp", "ktx2", "basis"};
  std::error_code ignored;
  return std::find(pictures.begin(), pictures.end(), extension) == pictures.end() &&
         std::filesystem::is_regular_file(path, ignored);
}

bool read_buffer(std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                 void* access) {
  try {
    const FileBytes buffer = read_file(path, static_cast<FileAccess*>(access)->monitor);
    bytes->assign(buffer.content.begin(), buffer.content.end());
    return true;
  } catch (const Error& failure) {
    *error = failure.what();
    return false;
  }
}

bool ignore_picture(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/,
                    std::string* /*warning*/, int /*width*/, int /*height*/,
                    const unsigned char* /*bytes*/, int /*size*/, void* /*data*/) {
  return true;
}

/// tinygltf trusts the length of a GLB file's second chunk; we do not.
void check_chunks(const FileBytes& file) {
  std::uint32_t announced = 0;
  if (file.content.size() >= 12) std::memcpy(&announced, file.content.data() + 8, 4);
  const std::size_t size = std::min<std::size_t>(file.content.size(), announced);
  for (std::size_t at = 12; at < size;) {
    std::uint32_t length = 0;
    if (size - at >= 8) std::memcpy(&length, file.content.data() + at, sizeof length);
    if (size - at < 8 || length > size - at - 8) {
      file.fail("a chunk of " + std::to_string(length) + " bytes at byte " + std::to_string(at) +
                    " of " + std::to_string(size),
                "chunks that end within the file", "the file is truncated: fetch it again");
    }
    at += 8 + std::size_t{length};
  }
}

/// The JSON chunk, or the file; known to lie within the file. Empty if there is none.
std::string_view json_of(const FileBytes& file, bool binary) {
  std::string_view json(file.content);
  if (!binary) return json;
  std::uint32_t length = 0;
  if (json.size() < 20) return {};  // the parser says so
  std::memcpy(&length, json.data() + 12, sizeof length);
  return json.substr(20, length);
}

/// tinygltf goes down into "extras" and extensions by recursion.
void check_depth(const FileBytes& file, std::string_view json) {
  const int depth = json_depth(json);
  if (depth <= deepest_json) return;
  file.fail("JSON nested " + std::to_string(depth) + " deep",
            "at most " + std::to_string(deepest_json), "export the file again");
}

[[noreturn]] void refuse_version(const FileBytes& file) {
  file.fail("glTF 1.0", "glTF 2.0", "convert it, for instance with gltf-pipeline or Blender");
}

/// Extensions that change only how things look or what they mean, by parts of their names.
bool changes_no_geometry(std::string_view extension) {
  constexpr std::array<std::string_view, 10> parts{
      "material", "texture", "light", "anim", "metadata", "features", "xmp", "audio", "VRM", "VCI"};
  return extension == draco_extension || extension == meshopt_extension ||
         extension == "KHR_mesh_quantization" ||
         std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return extension.find(part) != extension.npos; });
}

void check_required(const FileBytes& file, const std::vector<std::string>& extensions) {
  for (const std::string& extension : extensions) {
    if (changes_no_geometry(extension)) continue;
    file.fail("the extension " + in_quotes(extension) + ", without which the file says that it " +
                  "cannot be read",
              "glTF 2.0 with compression at most", "export the file without that extension");
  }
}

/// The reasons for which tinygltf refuses files without naming them.
void explain_refusal(const FileBytes& file, std::string_view json) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  if (!parsed.is_object()) return;
  const auto required = parsed.find("extensionsRequired");
  if (required != parsed.end() && required->is_array()) {
    std::vector<std::string> names;
    for (const auto& name : *required) {
      if (name.is_string()) names.push_back(name.get<std::string>());
    }
    check_required(file, names);
  }
  const auto meshes = parsed.find("meshes");  // named in version 1, numbered in version 2
  if (meshes != parsed.end() && meshes->is_object()) refuse_version(file);
}

/// The file with other JSON.
FileBytes with_json(const FileBytes& file, bool binary, std::string json) {
  if (!binary) return {file.path, std::move(json)};
  std::uint32_t announced = 0;
  std::uint32_t length = 0;
  std::memcpy(&announced, file.content.data() + 8, sizeof announced);
  std::memcpy(&length, file.content.data() + 12, sizeof length);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t end = std::min<std::size_t>(file.content.size(), announced);
  const std::string_view rest =
      std::string_view(file.content).substr(0, end).substr(20 + std::size_t{length});
  FileBytes changed{file.path, file.content.substr(0, 20)};
  const auto put = [&](std::size_t at, std::size_t number) {
    const auto word = static_cast<std::uint32_t>(number);
    std::memcpy(changed.content.data() + at, &word, sizeof word);
  };
  put(8, 20 + json.size() + rest.size());
  put(12, json.size());
  changed.content += json;
  changed.content += rest;
  return changed;
}

/// False: refused, with the reason.
bool parse(const FileBytes& file, bool binary, const Monitor& monitor, tinygltf::Model& model,
           std::string& error) {
  FileAccess access{file, monitor};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(ignore_picture, nullptr);
  parser.SetFsCallbacks({buffer_exists,
                         [](const std::string& path, void* /*access*/) { return path; },
                         read_buffer, nullptr, &access});
  std::string warning;
  const auto size = static_cast<unsigned>(file.content.size());
  const std::string folder = file.path.parent_path().string();
  try {
    return binary ? parser.LoadBinaryFromMemory(
                        &model, &error, &warning,
                        reinterpret_cast<const unsigned char*>(file.content.data()), size, folder)
                  : parser.LoadASCIIFromString(&model, &error, &warning, file.content.data(), size,
                                               folder);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& failure) {
    error += failure.what();
    return false;
  }
}

}  // namespace

std::string_view gltf_json(const FileBytes& file) {
  return json_of(file, file.content.starts_with("glTF"));
}

tinygltf::Model parse_gltf(const FileBytes& file, const Monitor& monitor,
                           GltfAttributes attributes) {
  const bool binary = file.content.starts_with("glTF");
  if (binary && file.content.substr(4, 4) == std::string_view("\1\0\0\0", 4)) refuse_version(file);
  if (binary) check_chunks(file);
  const std::string_view json = json_of(file, binary);
  check_depth(file, json);
  if (file.content.size() > 0xffffffffU) {
    file.fail(std::to_string(file.content.size()) + " bytes", "at most 4294967295",
              "convert it to binary PLY");
  }
  tinygltf::Model model;
  std::string error;
  auto changed = json_for_tinygltf(json, binary);
  const bool parsed =
      changed ? parse(with_json(file, binary, std::move(*changed)), binary, monitor, model, error)
              : parse(file, binary, monitor, model, error);
  if (!parsed) {
    explain_refusal(file, json);
    std::replace(error.begin(), error.end(), '\n', ' ');
    file.fail("what the glTF parser refuses: " + error, "glTF 2.0 with all of its buffers",
              "fetch or export the file again, with its .bin beside it");
  }
  if (model.asset.version.starts_with("1") || model.asset.version.starts_with("0")) {
    refuse_version(file);
  }
  check_required(file, model.extensionsRequired);
  decompress_gltf(file, model, attributes, monitor);
  return model;
}

}  // namespace curveskel
