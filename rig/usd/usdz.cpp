#include <zlib.h>

#include <cstdint>
#include <limits>
#include <string_view>

#include <curveskel/error.hpp>
#include "rig/usd/usd_of_glb.hpp"

namespace curveskel {
namespace {

void put_little(std::string& bytes, std::uint64_t number, int count) {
  for (int byte = 0; byte < count; ++byte) {
    bytes += static_cast<char>(number >> (8U * static_cast<unsigned>(byte)) & 0xFFU);
  }
}

struct UsdzEntry {
  std::string name;
  std::size_t begin = 0;  // of its header
  std::size_t size = 0;
  std::uint32_t checksum = 0;
};

/// From the version to the length of the name; the two kinds of headers have it alike.
void put_common(std::string& bytes, const UsdzEntry& entry) {
  constexpr std::uint16_t version = 20;
  constexpr std::uint16_t first_day = (1U << 5U) + 1;  // of 1980: files do not know when
  put_little(bytes, version, 2);
  put_little(bytes, 0, 2);  // flags
  put_little(bytes, 0, 2);  // stored
  put_little(bytes, 0, 2);  // midnight
  put_little(bytes, first_day, 2);
  put_little(bytes, entry.checksum, 4);
  put_little(bytes, entry.size, 4);
  put_little(bytes, entry.size, 4);
  put_little(bytes, entry.name.size(), 2);
}

class UsdzWriter {
 public:
  void add(const std::string& name, std::string_view content) {
    UsdzEntry entry{name, bytes_.size(), content.size(), checksum_of(content)};
    require_small(bytes_.size() + content.size());
    constexpr std::size_t header = 30;
    constexpr std::size_t extra_head = 4;
    constexpr std::size_t multiple = 64;
    const std::size_t unpadded = bytes_.size() + header + name.size() + extra_head;
    const std::size_t padding = (multiple - unpadded % multiple) % multiple;
    put_little(bytes_, 0x04034b50, 4);
    put_common(bytes_, entry);
    put_little(bytes_, extra_head + padding, 2);
    bytes_ += name;
    put_little(bytes_, 0x1986, 2);  // the number that Pixar's library has for padding
    put_little(bytes_, padding, 2);
    bytes_.append(padding, '\0');
    bytes_ += content;
    entries_.push_back(std::move(entry));
  }

  [[nodiscard]] std::string bytes() && {
    const std::size_t begin = bytes_.size();
    for (const UsdzEntry& entry : entries_) {
      constexpr std::uint16_t version = 20;
      put_little(bytes_, 0x02014b50, 4);
      put_little(bytes_, version, 2);
      put_common(bytes_, entry);
      bytes_.append(12, '\0');  // no extra field, no comment, first disk, no attributes
      put_little(bytes_, entry.begin, 4);
      bytes_ += entry.name;
    }
    const std::size_t size = bytes_.size() - begin;
    require_small(bytes_.size());
    put_little(bytes_, 0x06054b50, 4);
    put_little(bytes_, 0, 4);  // disks
    put_little(bytes_, entries_.size(), 2);
    put_little(bytes_, entries_.size(), 2);
    put_little(bytes_, size, 4);
    put_little(bytes_, begin, 4);
    put_little(bytes_, 0, 2);
    return std::move(bytes_);
  }

 private:
  static std::uint32_t checksum_of(std::string_view content) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()));
  }

  static void require_small(std::size_t size) {
    if (size < std::numeric_limits<std::uint32_t>::max()) return;
    throw Error(Fault::output, std::to_string(size) +
                                   " bytes, more than the 4 GB that a usdz file can have; write "
                                   ".usda instead");
  }

  std::string bytes_;
  std::vector<UsdzEntry> entries_;
};

}  // namespace

std::string usdz_of(const UsdLayer& layer, const std::string& name) {
  UsdzWriter writer;
  writer.add(name, layer.text);
  for (const SideFile& picture : layer.pictures) writer.add(picture.name, picture.bytes);
  return std::move(writer).bytes();
}

}  // namespace curveskel
