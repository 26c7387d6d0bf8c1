#include "rig/gltf/gltf_pictures.hpp"

#include <array>
#include <cstddef>
#include <system_error>
#include <utility>

#include "base/uri.hpp"
#include "base/utf8.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

/// Beside the file, as the URI says or as it is spelled.
std::optional<fs::path> picture_file(const FileBytes& file, const std::string& uri) {
  for (const std::string& name : {without_escapes(uri), uri}) {
    const fs::path path = file.path.parent_path() / name;
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) return path;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> picture_type(std::string_view bytes) {
  struct Known {
    std::size_t at;
    std::string_view bytes;
    const char* type;
  };
  constexpr std::array<Known, 5> all{{{0, "\x89PNG", "image/png"},
                                      {0, "\xff\xd8\xff", "image/jpeg"},
                                      {8, "WEBP", "image/webp"},
                                      {1, "KTX 20", "image/ktx2"},
                                      {0, "DDS ", "image/vnd-ms.dds"}}};
  for (const Known& known : all) {
    if (bytes.size() > known.at && bytes.substr(known.at).starts_with(known.bytes)) {
      return known.type;
    }
  }
  return std::nullopt;
}

void take_in_pictures(GltfDocument& document, const FileBytes& file,
                      std::vector<std::string>& notes, const Monitor& monitor) {
  if (!document.json.contains("images")) return;
  for (std::size_t i = 0; i < document.json["images"].size(); ++i) {
    OrderedJson& image = document.json["images"][i];
    const std::string uri = image.value("uri", "");
    if (uri.empty() || uri.starts_with("data:")) continue;
    const auto path = picture_file(file, uri);
    const std::string bytes = path ? read_file(*path, monitor, "a picture").content : "";
    const auto type = picture_type(bytes);
    if (!type) {
      notes.push_back("the picture " + in_quotes(uri) + " is " +
                      (path ? "of no kind that glTF has" : "missing") + ", and stays outside");
      continue;
    }
    image.erase("uri");
    if (!image.contains("name")) image["name"] = as_utf8(path->stem().string());
    image["mimeType"] = *type;
    image["bufferView"] = add_view(document, bytes);
  }
}

}  // namespace curveskel
