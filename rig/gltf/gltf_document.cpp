#include "rig/gltf/gltf_document.hpp"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/base64.hpp"
#include "rig/gltf/gltf_pictures.hpp"
#include "rig/gltf/number_bytes.hpp"
#include "surface/read/gltf_file.hpp"

namespace curveskel {
namespace {

void pad(std::string& bytes, char with) { bytes.resize((bytes.size() + 3) / 4 * 4, with); }

void put_word(std::string& bytes, std::size_t number) {
  const auto word = static_cast<std::uint32_t>(number);
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// A place that meshopt leaves for programs that do not decompress.
bool holds_nothing(const OrderedJson& buffer) {
  const OrderedJson::json_pointer fallback("/extensions/EXT_meshopt_compression/fallback");
  return buffer.contains(fallback) && buffer[fallback] == true;
}

/// All buffers one after the other, and the views where their bytes are now.
void join_buffers(GltfDocument& document, const tinygltf::Model& model) {
  for (const char* name : {"buffers", "bufferViews"}) (void)array_in(document.json, name);
  OrderedJson& buffers = document.json["buffers"];  // a new member would move it
  OrderedJson& views = document.json["bufferViews"];
  std::vector<std::size_t> begins;
  for (std::size_t k = 0; k < buffers.size() && k < model.buffers.size(); ++k) {
    pad(document.numbers, '\0');
    begins.push_back(document.numbers.size());
    if (holds_nothing(buffers[k])) continue;
    const auto& bytes = model.buffers[k].data;
    document.numbers.append(bytes.begin(), bytes.end());
  }
  for (OrderedJson& view : views) {
    const std::size_t buffer = view.at("buffer").get<std::size_t>();
    if (begins.at(buffer) == 0 && buffer == 0) continue;
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + begins[buffer];
    view["buffer"] = 0;
  }
  OrderedJson first = buffers.empty() ? OrderedJson::object() : buffers.front();
  first.erase("uri");
  buffers = OrderedJson::array({std::move(first)});
}

/// Of a binary file what follows its JSON, without the first chunk of numbers.
std::string unknown_chunks(const FileBytes& file) {
  const std::string_view bytes = file.content;
  if (!bytes.starts_with("glTF")) return "";
  const auto word = [&](std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return std::size_t{number};
  };
  const std::size_t end = std::min(bytes.size(), word(8));
  std::size_t at = 20 + word(12);
  const bool has_numbers = at + 8 <= end && bytes.substr(at + 4, 4) == std::string_view("BIN\0", 4);
  if (has_numbers) at += 8 + word(at);
  return at < end ? std::string(bytes.substr(at, end - at)) : "";
}

void require_four_gigabytes(std::size_t size) {
  if (size <= std::numeric_limits<std::uint32_t>::max()) return;
  throw Error(Fault::output, std::to_string(size) +
                                 " bytes, more than the 4 GB that a glTF file can have; "
                                 "decimate the surface or shrink its pictures");
}

}  // namespace

OrderedJson& array_in(OrderedJson& object, const std::string& name) {
  OrderedJson& array = object[name];
  if (!array.is_array()) array = OrderedJson::array();
  return array;
}

GltfDocument read_gltf_document(const FileBytes& file, const tinygltf::Model& model,
                                std::vector<std::string>& notes, const Monitor& monitor) {
  GltfDocument document;
  try {
    document.json = OrderedJson::parse(gltf_json(file));
    join_buffers(document, model);
    document.chunks = unknown_chunks(file);
    take_in_pictures(document, file, notes, monitor);
  } catch (const nlohmann::json::exception& failure) {
    file.fail(std::string("what the JSON parser refuses: ") + failure.what(), "glTF 2.0",
              "export the file again");
  } catch (const std::out_of_range& failure) {
    file.fail(std::string("a number of what is not there: ") + failure.what(), "glTF 2.0",
              "export the file again");
  }
  return document;
}

std::size_t add_view(GltfDocument& document, std::string_view bytes, int target) {
  pad(document.numbers, '\0');
  OrderedJson view{
      {"buffer", 0}, {"byteOffset", document.numbers.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  document.numbers += bytes;
  OrderedJson& views = array_in(document.json, "bufferViews");
  views.push_back(std::move(view));
  return views.size() - 1;
}

std::size_t add_accessor(GltfDocument& document, std::string_view rows, const std::string& type,
                         int component, std::size_t count, int target) {
  const std::size_t view = add_view(document, rows, target);
  OrderedJson& accessors = array_in(document.json, "accessors");
  accessors.push_back(
      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return accessors.size() - 1;
}

std::size_t add_places(GltfDocument& document, const Eigen::Matrix3Xf& places) {
  std::string rows;
  for (const float number : places.reshaped()) put_number(rows, number);
  const std::size_t accessor =
      add_accessor(document, rows, "VEC3", gltf_float, idx(places.cols()), gltf_vertices);
  Eigen::AlignedBox3f box;
  for (const auto& place : places.colwise()) {
    if (place.allFinite()) box.extend(Eigen::Vector3f(place));
  }
  if (box.isEmpty()) box.extend(Eigen::Vector3f(Eigen::Vector3f::Zero()));
  OrderedJson& written = document.json["accessors"][accessor];
  for (Eigen::Index k = 0; k < 3; ++k) {
    written["min"].push_back(box.min()[k]);
    written["max"].push_back(box.max()[k]);
  }
  return accessor;
}

std::string glb_head(std::string json, std::size_t rest) {
  pad(json, ' ');
  const std::size_t size = 20 + json.size() + rest;
  require_four_gigabytes(size);
  std::string bytes = "glTF";
  bytes.reserve(size);
  put_word(bytes, 2);
  put_word(bytes, size);
  put_word(bytes, json.size());
  bytes += "JSON";
  return bytes += json;
}

std::string format_gltf(GltfDocument document, RigFormat format) {
  pad(document.numbers, '\0');
  require_four_gigabytes(document.numbers.size());
  OrderedJson& buffer = document.json["buffers"][0];
  buffer["byteLength"] = document.numbers.size();
  const auto dumped = [&] {
    return document.json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  };
  if (format == RigFormat::gltf) {
    buffer["uri"] = "data:application/octet-stream;base64," + base64_of(document.numbers);
    return dumped();
  }
  std::string bytes = glb_head(dumped(), 8 + document.numbers.size() + document.chunks.size());
  put_word(bytes, document.numbers.size());
  bytes += std::string_view("BIN\0", 4);
  bytes += document.numbers;
  bytes += document.chunks;
  return bytes;
}

}  // namespace curveskel
