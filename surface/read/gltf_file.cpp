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

int type_of_rows(int components) {
  switch (components) {
    case 3:
      return TINYGLTF_TYPE_VEC3;
    case 4:
      return TINYGLTF_TYPE_VEC4;
    case 16:
      return TINYGLTF_TYPE_MAT4;
    default:
      return TINYGLTF_TYPE_SCALAR;
  }
}

std::optional<GltfNumbers::Type> number_type(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return GltfNumbers::Type::int8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return GltfNumbers::Type::uint8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return GltfNumbers::Type::int16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return GltfNumbers::Type::uint16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return GltfNumbers::Type::uint32;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return GltfNumbers::Type::float32;
    default:
      return std::nullopt;
  }
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

GltfNumbers gltf_numbers(const FileBytes& file, const tinygltf::Model& model, int accessor,
                         int components, const std::string& meaning) {
  const auto& rows = gltf_element(file, model.accessors, accessor, "accessor");
  const auto refuse = [&](const std::string& found, const std::string& needed) {
    file.fail(found + " in accessor " + std::to_string(accessor) + " (" + meaning + ")", needed,
              "export the file again");
  };
  if (rows.sparse.isSparse) refuse("sparse storage", "plain storage");
  const auto& view = gltf_element(file, model.bufferViews, rows.bufferView, "buffer view");
  const auto& buffer = gltf_element(file, model.buffers, view.buffer, "buffer");
  const auto type = number_type(rows.componentType);
  const int wanted = type_of_rows(components);
  const int stride = rows.ByteStride(view);
  if (!type || rows.type != wanted || stride <= 0) {
    refuse("numbers of type " + std::to_string(rows.type) + "/" +
               std::to_string(rows.componentType) + ", stride " + std::to_string(stride),
           std::to_string(components) + " per row of a type in the standard");
  }
  const auto component_bytes = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(rows.componentType)));
  const std::size_t row_bytes = component_bytes * static_cast<std::size_t>(components);
  const std::size_t size = buffer.data.size();
  const bool begins_inside = view.byteOffset <= size && rows.byteOffset <= size - view.byteOffset;
  const std::size_t left = begins_inside ? size - view.byteOffset - rows.byteOffset : 0;
  const bool ends_inside =
      begins_inside && (rows.count == 0 ||
                        (row_bytes <= left &&
                         rows.count - 1 <= (left - row_bytes) / static_cast<std::size_t>(stride)));
  if (!ends_inside) {
    refuse(std::to_string(rows.count) + " rows from byte " + std::to_string(view.byteOffset) +
               " + " + std::to_string(rows.byteOffset),
           "rows that end within the buffer's " + std::to_string(size) + " bytes");
  }
  return {buffer.data.data() + view.byteOffset + rows.byteOffset, static_cast<std::size_t>(stride),
          rows.count, *type, rows.normalized};
}

}  // namespace curveskel
