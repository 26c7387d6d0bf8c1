#include "surface/read/gltf_numbers.hpp"

#include <tiny_gltf.h>

#include <optional>

namespace curveskel {
namespace {

int type_of_rows(int components) {
  switch (components) {
    case 2:
      return TINYGLTF_TYPE_VEC2;
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

/// Reads the storage of one accessor.
class AccessorReader {
 public:
  AccessorReader(const FileBytes& file, const tinygltf::Model& model, int accessor, int components,
                 const std::string& meaning)
      : file_(file),
        model_(model),
        index_(accessor),
        rows_(gltf_element(file, model.accessors, accessor, "accessor")),
        components_(static_cast<std::size_t>(components)),
        meaning_(meaning) {
    type_ = number_type(rows_.componentType);
    if (!type_ || rows_.type != type_of_rows(components)) {
      refuse("numbers of type " + std::to_string(rows_.type) + "/" +
                 std::to_string(rows_.componentType),
             std::to_string(components) + " per row of a type in the standard");
    }
  }

  [[nodiscard]] GltfNumbers read() const {
    GltfNumbers::Block block;
    block.rows = rows_.count;
    if (rows_.bufferView >= 0) {
      const auto& view = gltf_element(file_, model_.bufferViews, rows_.bufferView, "buffer view");
      block = block_at(view, rows_.byteOffset, *type_, components_, rows_.count, view.byteStride);
    } else if (rows_.count > most_zeros) {
      refuse(std::to_string(rows_.count) + " rows of nothing", "a buffer view");
    }
    block.normalized = rows_.normalized;
    if (!rows_.sparse.isSparse) return GltfNumbers(block);
    return with_substitutes(block);
  }

 private:
  /// An accessor without storage may have so many rows: a lie about them costs no more than 1 GB.
  static constexpr std::size_t most_zeros = 10'000'000;

  [[nodiscard]] GltfNumbers with_substitutes(const GltfNumbers::Block& block) const {
    const auto& sparse = rows_.sparse;
    const auto index_type = number_type(sparse.indices.componentType);
    if (sparse.count < 0 || !index_type || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0) {
      refuse("sparse storage of " + std::to_string(sparse.count) + " rows", "the standard's");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto block_in = [&](const auto& place, GltfNumbers::Type type, std::size_t components) {
      const auto& view = gltf_element(file_, model_.bufferViews, place.bufferView, "buffer view");
      return block_at(view, static_cast<std::size_t>(place.byteOffset), type, components, count, 0);
    };
    const GltfNumbers::Block indices = block_in(sparse.indices, *index_type, 1);
    std::vector<std::size_t> replaced;
    replaced.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double row = indices.at(i, 0);
      if (!(row >= 0 && row < static_cast<double>(rows_.count)) ||
          (i > 0 && static_cast<std::size_t>(row) <= replaced.back())) {
        refuse("sparse row " + std::to_string(row),
               "ascending rows of the " + std::to_string(rows_.count) + " that there are");
      }
      replaced.push_back(static_cast<std::size_t>(row));
    }
    GltfNumbers::Block substitutes = block_in(sparse.values, *type_, components_);
    substitutes.normalized = rows_.normalized;
    return {block, std::move(replaced), substitutes};
  }

  /// A stride of zero: the rows follow one another.
  [[nodiscard]] GltfNumbers::Block block_at(const tinygltf::BufferView& view, std::size_t offset,
                                            GltfNumbers::Type type, std::size_t components,
                                            std::size_t count, std::size_t stride) const {
    const auto& buffer = gltf_element(file_, model_.buffers, view.buffer, "buffer");
    const std::size_t row_bytes = bytes_of(type) * components;
    if (stride == 0) stride = row_bytes;
    const std::size_t size = buffer.data.size();
    const bool begins_inside = view.byteOffset <= size && offset <= size - view.byteOffset;
    const std::size_t left = begins_inside ? size - view.byteOffset - offset : 0;
    const bool ends_inside =
        begins_inside &&
        (count == 0 || (row_bytes <= left && count - 1 <= (left - row_bytes) / stride));
    if (!ends_inside) {
      refuse(std::to_string(count) + " rows from byte " + std::to_string(view.byteOffset) + " + " +
                 std::to_string(offset),
             "rows that end within the buffer's " + std::to_string(size) + " bytes");
    }
    return {buffer.data.data() + view.byteOffset + offset, stride, count, type};
  }

  static std::size_t bytes_of(GltfNumbers::Type type) {
    switch (type) {
      case GltfNumbers::Type::int8:
      case GltfNumbers::Type::uint8:
        return 1;
      case GltfNumbers::Type::int16:
      case GltfNumbers::Type::uint16:
        return 2;
      default:
        return 4;
    }
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& needed) const {
    file_.fail(found + " in accessor " + std::to_string(index_) + " (" + meaning_ + ")", needed,
               "export the file again");
  }

  const FileBytes& file_;
  const tinygltf::Model& model_;
  int index_;
  const tinygltf::Accessor& rows_;
  std::size_t components_;
  const std::string& meaning_;
  std::optional<GltfNumbers::Type> type_;
};

}  // namespace

GltfNumbers gltf_numbers(const FileBytes& file, const tinygltf::Model& model, int accessor,
                         int components, const std::string& meaning) {
  return AccessorReader(file, model, accessor, components, meaning).read();
}

}  // namespace curveskel
