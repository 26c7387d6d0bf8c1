#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/io/rig_writers.hpp"
#include "rig/skin/four_weights.hpp"

namespace curveskel {
namespace {

template <typename Number>
void put(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// An array as NumPy's format 1.0 has it, in C order. `type` as "<f8".
std::string npy(const std::string& type, const std::string& shape, const std::string& numbers) {
  std::string head =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t before = 10;  // magic, version, length
  head.append(63 - (before + head.size()) % 64, ' ');
  head += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  put(bytes, static_cast<std::uint16_t>(head.size()));
  return bytes + head + numbers;
}

/// UTF-8 as code points; what is no UTF-8 was replaced before.
std::vector<std::uint32_t> code_points(const std::string& text) {
  std::vector<std::uint32_t> points;
  for (std::size_t k = 0; k < text.size();) {
    const auto lead = static_cast<unsigned char>(text[k]);
    const int more = lead >= 0xF0 ? 3 : (lead >= 0xE0 ? 2 : (lead >= 0xC0 ? 1 : 0));
    std::uint32_t point = more == 0 ? lead : lead & (0x3FU >> more);
    for (int byte = 1; byte <= more; ++byte) {
      point = point << 6U |
              (static_cast<unsigned char>(text[k + static_cast<std::size_t>(byte)]) & 0x3FU);
    }
    points.push_back(point);
    k += static_cast<std::size_t>(more) + 1;
  }
  return points;
}

std::string npy_of(const std::vector<std::string>& words) {
  std::vector<std::vector<std::uint32_t>> texts;
  std::size_t longest = 1;
  for (const std::string& word : words) {
    texts.push_back(code_points(as_utf8(word)));
    longest = std::max(longest, texts.back().size());
  }
  std::string numbers;
  for (auto& text : texts) {
    text.resize(longest, 0);
    for (const std::uint32_t point : text) put(numbers, point);
  }
  return npy("<U" + std::to_string(longest), std::to_string(words.size()) + ",", numbers);
}

class ZipWriter {
 public:
  ZipWriter() {
    zip_error_t error;
    zip_error_init(&error);
    buffer_ = zip_source_buffer_create(nullptr, 0, 0, &error);
    if (buffer_ != nullptr) {
      zip_source_keep(buffer_);
      archive_ = zip_open_from_source(buffer_, ZIP_TRUNCATE, &error);
    }
    zip_error_fini(&error);
    require(archive_ != nullptr);
  }
  ~ZipWriter() {
    if (archive_ != nullptr) zip_discard(archive_);
    zip_source_free(buffer_);
  }
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// The bytes must last until `bytes`.
  void add(const std::string& name, const std::string& content) {
    zip_source_t* const source = zip_source_buffer(archive_, content.data(), content.size(), 0);
    require(source != nullptr);
    const zip_int64_t entry = zip_file_add(archive_, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (entry < 0) zip_source_free(source);
    require(entry >= 0);
    const auto number = static_cast<zip_uint64_t>(entry);
    constexpr zip_uint16_t first_day = (1U << 5U) + 1;  // of 1980: files do not know when
    require(zip_set_file_compression(archive_, number, ZIP_CM_STORE, 0) == 0 &&
            zip_file_set_dostime(archive_, number, 0, first_day, 0) == 0);
  }

  [[nodiscard]] std::string bytes() {
    require(zip_close(archive_) == 0);  // a failed one is left to the destructor
    archive_ = nullptr;
    require(zip_source_open(buffer_) == 0);
    zip_source_seek(buffer_, 0, SEEK_END);
    std::string result(static_cast<std::size_t>(zip_source_tell(buffer_)), '\0');
    zip_source_seek(buffer_, 0, SEEK_SET);
    const zip_int64_t read = zip_source_read(buffer_, result.data(), result.size());
    zip_source_close(buffer_);
    require(read == static_cast<zip_int64_t>(result.size()));
    return result;
  }

 private:
  static void require(bool done) {
    if (!done) throw Error(Fault::output, "the .npz archive cannot be made; write .json instead");
  }

  zip_source_t* buffer_ = nullptr;
  zip_t* archive_ = nullptr;
};

}  // namespace

std::string format_npz_rig(const Rig& rig) {
  const Eigen::Index joints = rig.joints.rows();
  const Eigen::Index vertices = rig.weights.rows();
  const std::string by_joint = std::to_string(joints) + ",";
  std::string places;
  for (const auto& place : rig.joints.rowwise()) {
    for (const double coordinate : place) put(places, coordinate);
  }
  std::string parents;
  for (const int parent : rig.parents) put(parents, static_cast<std::int32_t>(parent));
  std::string numbers;
  std::string weights;
  for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
    const FourWeights four = four_weights(rig.weights, vertex);
    for (const int joint : four.joints) put(numbers, static_cast<std::int32_t>(joint));
    for (const float weight : four.weights) put(weights, weight);
  }
  std::vector<std::string> roles = rig.roles;
  roles.resize(idx(joints));
  const std::string by_vertex = std::to_string(vertices) + ", 4";
  const std::vector<std::pair<std::string, std::string>> arrays{
      {"joints.npy", npy("<f8", std::to_string(joints) + ", 3", places)},
      {"parents.npy", npy("<i4", by_joint, parents)},
      {"names.npy", npy_of(rig.names)},
      {"roles.npy", npy_of(roles)},
      {"weight_joints.npy", npy("<i4", by_vertex, numbers)},
      {"weights.npy", npy("<f4", by_vertex, weights)},
  };
  ZipWriter zip;
  for (const auto& [name, content] : arrays) zip.add(name, content);
  return zip.bytes();
}

}  // namespace curveskel
