// A glTF file parsed, and the numbers that its accessors name; `read_gltf` walks over the scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Text or GLB, with the buffers beside it; pictures are not loaded.
/// Throws Error(Fault::input), also for compressed geometry.
[[nodiscard]] tinygltf::Model parse_gltf(const FileBytes& file, const Monitor& monitor);

/// The rows of one accessor, known to lie within their buffer; valid as long as the model.
class GltfNumbers {
 public:
  enum class Type { int8, uint8, int16, uint16, uint32, float32 };

  GltfNumbers(const unsigned char* data, std::size_t stride, std::size_t rows, Type type,
              bool normalized)
      : data_(data), stride_(stride), rows_(rows), type_(type), normalized_(normalized) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Precondition: row < rows(), component < those of the accessor's type.
  [[nodiscard]] double at(std::size_t row, std::size_t component) const {
    switch (type_) {
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
    std::memcpy(&value, data_ + row * stride_ + component * sizeof(Value), sizeof(Value));
    return value;
  }
  [[nodiscard]] double scaled(int value, int largest) const {
    return normalized_ ? std::max(-1.0, static_cast<double>(value) / largest) : value;
  }

  const unsigned char* data_;
  std::size_t stride_;
  std::size_t rows_;
  Type type_;
  bool normalized_;
};

/// `components` numbers per row: 1, 3, 4 or 16 (a matrix by columns); `meaning` is for messages.
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
