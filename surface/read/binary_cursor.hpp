// A position in the binary part of a file, for readers whose numbers come one after the other.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

class BinaryCursor {
 public:
  /// From byte `begin` of the file, which must outlive the cursor.
  BinaryCursor(const FileBytes& file, std::size_t begin, std::endian order)
      : file_(&file), place_(begin), swapped_(order != std::endian::native) {}

  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] std::size_t bytes_left() const { return file_->content.size() - place_; }
  [[nodiscard]] double fraction() const {
    return static_cast<double>(place_) / static_cast<double>(file_->content.size());
  }

  /// Throws Error(Fault::input) if fewer than `bytes` are left.
  void require(std::size_t bytes) const {
    if (bytes > bytes_left()) {
      file_->fail(std::to_string(bytes_left()) + " bytes after byte " + std::to_string(place_),
                  std::to_string(bytes) + " there",
                  "the file is truncated or broken: fetch or export it again");
    }
  }
  void skip(std::size_t bytes) {
    require(bytes);
    place_ += bytes;
  }
  template <typename Value>
  [[nodiscard]] Value take() {
    require(sizeof(Value));
    std::array<char, sizeof(Value)> raw{};
    std::memcpy(raw.data(), file_->content.data() + place_, sizeof(Value));
    if (swapped_) std::reverse(raw.begin(), raw.end());
    place_ += sizeof(Value);
    return std::bit_cast<Value>(raw);
  }

 private:
  const FileBytes* file_;
  std::size_t place_;
  bool swapped_;
};

}  // namespace curveskel
