// The numbers that the accessors of a glTF file name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// The rows of one accessor, known to lie within their buffers; valid as long as the model.
class GltfNumbers {
 public:
  enum class Type { int8, uint8, int16, uint16, uint32, float32 };

  /// Rows at equal distances; no data: rows of zeros.
  struct Block {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
    std::size_t rows = 0;
    Type type = Type::float32;
    bool normalized = false;

    [[nodiscard]] double at(std::size_t row, std::size_t component) const {
      switch (type) {
        case Type::int8:
          return scaled(fetch<std::int8_t>(row, component), 127);
        case Type::uint8:
          return scaled(fetch<std::uint8_t>(row, component), 255);
        case Type::int16:
          return scaled(fetch<std::int16_t>(row, component), 32767);
        case Type::uint16:
          return scaled(fetch<std::uint16_t>(row, component), 65535);
        case Type::uint32:
          return fetch<std::uint32_t>(row, component);
        case Type::float32:
          return static_cast<double>(fetch<float>(row, component));
      }
      return 0;
    }

   private:
    template <typename Value>
    [[nodiscard]] Value fetch(std::size_t row, std::size_t component) const {
      Value value{};
      std::memcpy(&value, data + row * stride + component * sizeof(Value), sizeof(Value));
      return value;
    }
    [[nodiscard]] double scaled(int value, int largest) const {
      return normalized ? std::max(-1.0, static_cast<double>(value) / largest) : value;
    }
  };

  explicit GltfNumbers(const Block& block) : block_(block) {}
  /// Row replaced[i], ascending, is row i of the substitutes (the standard's sparse storage).
  GltfNumbers(const Block& block, std::vector<std::size_t> replaced, const Block& substitutes)
      : block_(block), replaced_(std::move(replaced)), substitutes_(substitutes) {}

  [[nodiscard]] std::size_t rows() const { return block_.rows; }
  /// Precondition: row < rows(), component < those of the accessor's type.
  [[nodiscard]] double at(std::size_t row, std::size_t component) const {
    if (!replaced_.empty()) {
      const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), row);
      if (found != replaced_.end() && *found == row) {
        return substitutes_.at(static_cast<std::size_t>(found - replaced_.begin()), component);
      }
    }
    return block_.data == nullptr ? 0 : block_.at(row, component);
  }

 private:
  Block block_;
  std::vector<std::size_t> replaced_;
  Block substitutes_;
};

/// `components` numbers per row: 1 to 4 or 16 (a matrix by columns); `meaning` is for messages.
/// Throws Error(Fault::input).
[[nodiscard]] GltfNumbers gltf_numbers(const FileBytes& file, const tinygltf::Model& model,
                                       int accessor, int components, const std::string& meaning);

/// things[index]; throws Error(Fault::input) if there is none.
template <typename Things>
const auto& gltf_element(const FileBytes& file, const Things& things, int index,
                         const std::string& meaning) {
  if (index < 0 || static_cast<std::size_t>(index) >= things.size()) {
    file.fail(meaning + " " + std::to_string(index),
              "one of the " + std::to_string(things.size()) + " that there are",
              "export the file again");
  }
  return things[static_cast<std::size_t>(index)];
}

}  // namespace curveskel
