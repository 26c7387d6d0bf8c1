// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html has the layout of the blocks.
#include "surface/read/vtk_array.hpp"

#include <fast_float/fast_float.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/base64.hpp"
#include "base/memory.hpp"

namespace curveskel {
namespace {

/// Bytes that are fetched one block after the other, decoded on the way.
class Blocks {
 public:
  Blocks(std::string_view encoded, bool base64) : rest_(encoded), base64_(base64) {}

  /// Fewer than `count` where the data ends.
  std::string take(std::size_t count) {
    if (!base64_) {
      std::string taken(rest_.substr(0, count));
      rest_.remove_prefix(taken.size());
      return taken;
    }
    append_from_base64(decoded_, rest_, count);
    std::string taken = decoded_.substr(0, count);
    decoded_.erase(0, taken.size());
    return taken;
  }

 private:
  std::string_view rest_;
  std::string decoded_;
  bool base64_;
};

template <typename Value>
Value value_at(std::string_view bytes, std::size_t index, bool swapped) {
  std::array<char, sizeof(Value)> raw{};
  std::memcpy(raw.data(), bytes.data() + index * sizeof(Value), sizeof(Value));
  if (swapped) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Value>(raw);
}

template <typename Value>
std::vector<double> values_of(std::string_view bytes, bool swapped) {
  std::vector<double> values(bytes.size() / sizeof(Value));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(value_at<Value>(bytes, i, swapped));
  }
  return values;
}

/// One array, and all that a message about it needs.
class ArrayReader {
 public:
  ArrayReader(const FileBytes& file, const XmlElement& vtk_file, const XmlElement& array,
              double most_values)
      : file_(file),
        vtk_file_(vtk_file),
        array_(array),
        most_values_(most_values),
        swapped_(vtk_file.attribute("byte_order", "LittleEndian") == "BigEndian") {
    static_assert(std::endian::native == std::endian::little);
  }

  [[nodiscard]] std::vector<double> values() const {
    const std::string_view format = array_.attribute("format", "ascii");
    if (format == "ascii") return text_values();
    if (format == "binary") return typed(unpacked(Blocks(array_.text, true)));
    if (format == "appended") return typed(unpacked(appended()));
    fail("the format " + in_quotes(format), "ascii, binary or appended");
  }

 private:
  [[noreturn]] void fail(std::string_view found, std::string_view needed) const {
    fail_at(file_, array_.position,
            "the array " + in_quotes(array_.attribute("Name")) + " with " + std::string(found),
            needed);
  }

  [[nodiscard]] std::vector<double> text_values() const {
    std::vector<double> values;
    const char* at = array_.text.data();
    const char* const end = at + array_.text.size();
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    for (;;) {
      at = std::find_if_not(at, end, blank);
      if (at == end) return values;
      double value = 0;
      const auto [next, error] = fast_float::from_chars(*at == '+' ? at + 1 : at, end, value);
      if (error != std::errc() || (next != end && !blank(*next))) {
        fail(in_quotes(
                 std::string_view(at, static_cast<std::size_t>(std::find_if(at, end, blank) - at))),
             "numbers");
      }
      values.push_back(value);
      at = next;
    }
  }

  [[nodiscard]] Blocks appended() const {
    const XmlElement* data = vtk_file_.child("AppendedData");
    const std::string_view text = data == nullptr ? std::string_view() : data->text;
    const std::size_t begin = text.find('_');
    const std::string_view digits = array_.attribute("offset");
    std::size_t offset = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), offset);
    if (error != std::errc() || end != digits.data() + digits.size() ||
        begin == std::string_view::npos || offset >= text.size() - begin - 1) {
      fail("the offset " + in_quotes(digits), "a place in <AppendedData>");
    }
    return {text.substr(begin + 1 + offset), data->attribute("encoding") == "base64"};
  }

  [[nodiscard]] std::vector<std::uint64_t> header(Blocks& blocks, std::size_t count) const {
    const bool wide = vtk_file_.attribute("header_type", "UInt32") == "UInt64";
    const std::size_t size = wide ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    const std::string bytes = blocks.take(count * size);
    if (bytes.size() != count * size) fail("no data", "a header and data");
    std::vector<std::uint64_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      numbers[i] = wide ? value_at<std::uint64_t>(bytes, i, swapped_)
                        : value_at<std::uint32_t>(bytes, i, swapped_);
    }
    return numbers;
  }

  std::string taken(Blocks& blocks, std::uint64_t count) const {
    std::string bytes = blocks.take(std::min<std::uint64_t>(count, file_.content.size()));
    if (bytes.size() != count) {
      fail(std::to_string(bytes.size()) + " bytes of data",
           std::to_string(count) + ", as its header says");
    }
    return bytes;
  }

  /// For an array of so many bytes once it is unpacked, and its numbers as doubles.
  void require_room(double bytes) const {
    const double values = bytes / static_cast<double>(bytes_of_type());
    if (values > most_values_) {
      fail(std::to_string(static_cast<std::int64_t>(values)) + " values",
           std::to_string(static_cast<std::int64_t>(most_values_)) + ", as its piece says");
    }
    // Numbers are copied once more, with room to grow.
    require_memory(2 * bytes + 3 * sizeof(double) * values, available_memory_bytes(),
                   file_.path.string() + ", unpacked", Fault::input,
                   "it is too large for this machine, or no honest file");
  }

  /// 1 for types that are none, which `typed` refuses.
  [[nodiscard]] std::size_t bytes_of_type() const {
    const std::string_view type = array_.attribute("type");
    return type.ends_with("64") ? 8 : type.ends_with("32") ? 4 : type.ends_with("16") ? 2 : 1;
  }

  [[nodiscard]] std::string unpacked(Blocks blocks) const {
    const std::string_view compressor = vtk_file_.attribute("compressor");
    if (compressor.empty()) return taken(blocks, header(blocks, 1)[0]);
    if (compressor != "vtkZLibDataCompressor") {
      fail("the compressor " + in_quotes(compressor), "vtkZLibDataCompressor or none");
    }
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 32U;
    const auto sizes = header(blocks, 3);  // blocks, bytes of each but the last, of the last
    if (sizes[0] > file_.content.size() || sizes[1] > most_bytes || sizes[2] > most_bytes) {
      fail("a header of impossible sizes", "blocks that fit into the file");
    }
    const auto packed_sizes = header(blocks, sizes[0]);
    const double whole = static_cast<double>(sizes[0] - std::min<std::uint64_t>(sizes[0], 1)) *
                             static_cast<double>(sizes[1]) +
                         static_cast<double>(sizes[2] > 0 ? sizes[2] : sizes[1]);
    require_room(whole);
    std::string all;
    all.reserve(static_cast<std::size_t>(whole));
    for (std::size_t b = 0; b < packed_sizes.size(); ++b) {
      const bool last = b + 1 == packed_sizes.size();
      const std::uint64_t size = last && sizes[2] > 0 ? sizes[2] : sizes[1];
      const std::string packed = taken(blocks, packed_sizes[b]);
      constexpr std::uint64_t best_ratio = 1100;  // of deflate
      if (size > best_ratio * (packed.size() + 1))
        fail("a block of impossible size", "a sound one");
      std::string bytes(size, '\0');
      uLongf length = size;
      if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                     reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
          length != size) {
        fail("a block that zlib cannot unpack", "a sound one");
      }
      all += bytes;
    }
    return all;
  }

  [[nodiscard]] std::vector<double> typed(const std::string& bytes) const {
    const std::string_view type = array_.attribute("type");
    if (type == "Float64") return values_of<double>(bytes, swapped_);
    if (type == "Float32") return values_of<float>(bytes, swapped_);
    if (type == "Int64") return values_of<std::int64_t>(bytes, swapped_);
    if (type == "UInt64") return values_of<std::uint64_t>(bytes, swapped_);
    if (type == "Int32") return values_of<std::int32_t>(bytes, swapped_);
    if (type == "UInt32") return values_of<std::uint32_t>(bytes, swapped_);
    if (type == "Int16") return values_of<std::int16_t>(bytes, swapped_);
    if (type == "UInt16") return values_of<std::uint16_t>(bytes, swapped_);
    if (type == "Int8") return values_of<std::int8_t>(bytes, swapped_);
    if (type == "UInt8") return values_of<std::uint8_t>(bytes, swapped_);
    fail("the type " + in_quotes(type), "an integer or floating-point type");
  }

  const FileBytes& file_;
  const XmlElement& vtk_file_;
  const XmlElement& array_;
  double most_values_;
  bool swapped_;
};

}  // namespace

std::vector<double> vtk_values(const FileBytes& file, const XmlElement& vtk_file,
                               const XmlElement& data_array, double most_values) {
  return ArrayReader(file, vtk_file, data_array, most_values).values();
}

}  // namespace curveskel
