#include "surface/read/gltf_file.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/json_depth.hpp"

namespace curveskel {
namespace {

/// The data that tinygltf hands to the callbacks below.
struct FileAccess {
  const FileBytes& file;
  const Monitor& monitor;
};

/// Pictures are reported missing, which tinygltf takes as a warning: they carry no geometry.
bool buffer_exists(const std::string& path, void* /*access*/) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 6> pictures{".png",  ".jpg",  ".jpeg",
                                                     ".webp", ".ktx2", ".basis"};
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

/// tinygltf goes down into "extras" and extensions by recursion.
void check_depth(const FileBytes& file, bool binary) {
  std::string_view json(file.content);
  if (binary) {
    std::uint32_t length = 0;
    if (json.size() < 20) return;  // the parser says so
    std::memcpy(&length, json.data() + 12, sizeof length);
    json = json.substr(20, length);
  }
  const int depth = json_depth(json);
  if (depth <= deepest_json) return;
  file.fail("JSON nested " + std::to_string(depth) + " deep",
            "at most " + std::to_string(deepest_json), "export the file again");
}

}  // namespace

tinygltf::Model parse_gltf(const FileBytes& file, const Monitor& monitor) {
  const bool binary = file.content.starts_with("glTF");
  if (binary) check_chunks(file);
  check_depth(file, binary);
  if (file.content.size() > 0xffffffffU) {
    file.fail(std::to_string(file.content.size()) + " bytes", "at most 4294967295",
              "convert it to binary PLY");
  }
  FileAccess access{file, monitor};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(ignore_picture, nullptr);
  parser.SetFsCallbacks({buffer_exists,
                         [](const std::string& path, void* /*access*/) { return path; },
                         read_buffer, nullptr, &access});
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool parsed = false;
  const auto size = static_cast<unsigned>(file.content.size());
  const std::string folder = file.path.parent_path().string();
  try {
    parsed = binary ? parser.LoadBinaryFromMemory(
                          &model, &error, &warning,
                          reinterpret_cast<const unsigned char*>(file.content.data()), size, folder)
                    : parser.LoadASCIIFromString(&model, &error, &warning, file.content.data(),
                                                 size, folder);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& failure) {
    error += failure.what();
  }
  if (!parsed) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    file.fail("what the glTF parser refuses: " + error, "glTF 2.0 with all of its buffers",
              "fetch or export the file again, with its .bin beside it");
  }
  for (const std::string& extension : model.extensionsRequired) {
    if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression") {
      file.fail("compression by " + extension, "uncompressed glTF",
                "decompress it, for instance with gltf-transform or gltfpack");
    }
  }
  return model;
}

}  // namespace curveskel
