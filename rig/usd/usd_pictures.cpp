#include "rig/usd/usd_pictures.hpp"

#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/indices.hpp>
#include "base/base64.hpp"
#include "base/uri.hpp"
#include "rig/gltf/gltf_pictures.hpp"
#include "rig/gltf/picture_as_png.hpp"
#include "rig/usd/usd_names.hpp"
#include "surface/read/gltf_file.hpp"

namespace curveskel {
namespace {

/// By image, empty where none is given; the parser gives those that stand in the JSON to nobody.
std::vector<std::string> addresses_in_json(const FileBytes& file) {
  std::vector<std::string> addresses;
  const auto gltf = nlohmann::json::parse(gltf_json(file), nullptr, false);
  const auto images = gltf.find("images");
  if (images == gltf.end()) return addresses;
  for (const auto& image : *images) {
    const auto uri = image.find("uri");
    const bool is_given = uri != image.end() && uri->is_string();
    addresses.push_back(is_given ? uri->get<std::string>() : "");
  }
  return addresses;
}

std::string picture_in_address(std::string_view address) {
  const std::size_t comma = address.find(";base64,");
  if (!address.starts_with("data:") || comma == std::string_view::npos) return "";
  std::string_view text = address.substr(comma + 8);
  std::string bytes;
  append_from_base64(bytes, text, text.size());
  return bytes;
}

std::string extension_for(const std::string& type) {
  return type == "image/png" ? ".png" : type == "image/jpeg" ? ".jpg" : ".webp";
}

}  // namespace

UsdPictures::UsdPictures(const FileBytes& file, const tinygltf::Model& model, std::string folder,
                         bool packed, std::vector<std::string>& notes)
    : file_(file), model_(model), folder_(std::move(folder)), packed_(packed), notes_(notes) {}

std::string UsdPictures::path_of(int image) {
  if (image < 0 || idx(image) >= model_.images.size()) return "";
  const auto known = paths_.find(image);
  if (known != paths_.end()) return known->second;
  return paths_[image] = add(image);
}

std::vector<SideFile> UsdPictures::taken() && { return std::move(taken_); }

std::string UsdPictures::bytes_in_json(int image) {
  if (!addresses_) addresses_ = addresses_in_json(file_);
  return idx(image) < addresses_->size() ? picture_in_address((*addresses_)[idx(image)]) : "";
}

std::string UsdPictures::bytes_of(int image) {
  const tinygltf::Image& given = model_.images[idx(image)];
  if (given.bufferView < 0) return given.uri.empty() ? bytes_in_json(image) : "";
  if (idx(given.bufferView) >= model_.bufferViews.size()) return "";
  const tinygltf::BufferView& view = model_.bufferViews[idx(given.bufferView)];
  if (view.buffer < 0 || idx(view.buffer) >= model_.buffers.size()) return "";
  const std::vector<unsigned char>& data = model_.buffers[idx(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) return "";
  return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
}

std::string UsdPictures::add(int image) {
  std::string bytes = bytes_of(image);
  if (bytes.empty()) return "";  // missing, which was noted when the file was read
  std::string name = model_.images[idx(image)].name;
  if (name.empty()) name = "picture_" + std::to_string(image + 1);
  std::string type = picture_type(bytes).value_or("");
  if (type.empty()) {
    if (auto png = picture_as_png(bytes)) {
      bytes = std::move(*png);
      type = "image/png";
    }
  }
  const bool is_webp = type == "image/webp";
  if (type != "image/png" && type != "image/jpeg" && (packed_ || !is_webp)) {
    notes_.push_back("the picture " + in_quotes(name) +
                     " is of a kind that USD does not have, and is left out; export it as PNG or "
                     "JPEG");
    return "";
  }
  if (is_webp) {
    notes_.push_back("the picture " + in_quotes(name) +
                     " is WebP, which few programs for USD show; export it as PNG or JPEG");
  }
  const std::string ending = extension_for(type);
  std::string stem = plain_file_name(name);
  const std::string lower = in_lower_case(stem);
  for (const char* end : {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp", ".gif", ".psd"}) {
    if (!lower.ends_with(end)) continue;
    stem.resize(stem.size() - std::string_view(end).size());
    break;
  }
  std::string free = stem;
  for (int number = 2; !names_.insert(in_lower_case(free + ending)).second; ++number) {
    free = stem;
    free.append("_").append(std::to_string(number));
  }
  taken_.push_back({folder_ + "/" + free + ending, std::move(bytes)});
  return "./" + taken_.back().name;
}

}  // namespace curveskel
