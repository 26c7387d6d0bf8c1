// The values of a PLY file, one after the other, in any encoding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "surface/read/file_bytes.hpp"
#include "surface/read/ply_header.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {

inline constexpr std::string_view ply_remedy =
    "the file is truncated or wrong there: fetch or export it again";

/// The place of a value, for messages.
struct PlyPlace {
  const PlyElement* element = nullptr;
  const PlyProperty* property = nullptr;
  std::int64_t row = 0;

  [[nodiscard]] std::string words() const {
    return " (row " + std::to_string(row) + " of element \"" + element->name + "\", property \"" +
           property->name + "\")";
  }
};

/// Indices and lengths fit into a double's 53 bits; larger ones, like NaN, are out of every range.
inline std::int64_t integer_from(double value) {
  return std::isnan(value) ? -2 : static_cast<std::int64_t>(std::clamp(value, -1e15, 1e15));
}

/// Fetches single values from text. `begin`: where in the content they start.
class AsciiPlyValues {
 public:
  AsciiPlyValues(const FileBytes& file, std::size_t begin) : text_(file) {
    text_.skip(begin - text_.position());
  }

  double number(PlyType /*type*/, const PlyPlace& place) {
    text_.skip_space(0);
    if (text_.done()) fail(place, "the end of the file", "a value");
    return text_.coordinate("a number");
  }
  std::int64_t integer(PlyType type, const PlyPlace& place) {
    if (type == PlyType::float32 || type == PlyType::float64) {
      return integer_from(number(type, place));
    }
    text_.skip_space(0);
    if (text_.done()) fail(place, "the end of the file", "a value");
    const TextCursor start = text_;
    const std::int64_t value = text_.integer("an integer");
    if (text_.peek() == '.') {  // some writers have 4.0
      text_ = start;
      const double number = text_.number("an integer");
      if (number != std::floor(number)) start.fail("an integer", ply_remedy);
      return integer_from(number);
    }
    text_.expect_word_end("an integer");
    return value;
  }
  void skip(PlyType /*type*/, std::int64_t count, const PlyPlace& place) {
    for (; count > 0; --count) {
      text_.skip_space(0);
      if (text_.done()) fail(place, "the end of the file", "a value");
      text_.word();
    }
  }
  [[nodiscard]] bool may_hold(PlyType /*type*/, std::int64_t count) const {
    return count <= static_cast<std::int64_t>(text_.bytes_left() / 2) + 1;
  }
  [[nodiscard]] double fraction() const { return text_.fraction(); }
  [[noreturn]] void fail(const PlyPlace& place, const std::string& found,
                         const std::string& needed) const {
    text_.fail(needed, ply_remedy, found + place.words());
  }

 private:
  TextCursor text_;
};

/// The same from bytes; `swapped`: in the other order than the machine's.
template <bool swapped>
class BinaryPlyValues {
 public:
  BinaryPlyValues(const FileBytes& file, std::size_t begin) : file_(file), at_(begin) {}

  double number(PlyType type, const PlyPlace& place) {
    switch (type) {
      case PlyType::int8:
        return fetch<std::int8_t>(place);
      case PlyType::uint8:
        return fetch<std::uint8_t>(place);
      case PlyType::int16:
        return fetch<std::int16_t>(place);
      case PlyType::uint16:
        return fetch<std::uint16_t>(place);
      case PlyType::int32:
        return fetch<std::int32_t>(place);
      case PlyType::uint32:
        return fetch<std::uint32_t>(place);
      case PlyType::int64:
        return static_cast<double>(fetch<std::int64_t>(place));
      case PlyType::uint64:
        return static_cast<double>(fetch<std::uint64_t>(place));
      case PlyType::float32:
        return static_cast<double>(fetch<float>(place));
      case PlyType::float64:
        return fetch<double>(place);
    }
    return 0;
  }
  std::int64_t integer(PlyType type, const PlyPlace& place) {
    if (type == PlyType::int32) return fetch<std::int32_t>(place);
    if (type == PlyType::uint8) return fetch<std::uint8_t>(place);
    return integer_from(number(type, place));
  }
  void skip(PlyType type, std::int64_t count, const PlyPlace& place) {
    if (!may_hold(type, count)) fail(place, "the end of the file", "a value");
    at_ += bytes_of(type) * static_cast<std::size_t>(count);
  }
  [[nodiscard]] bool may_hold(PlyType type, std::int64_t count) const {
    return count <= static_cast<std::int64_t>((file_.content.size() - at_) / bytes_of(type));
  }
  [[nodiscard]] double fraction() const {
    return static_cast<double>(at_) / static_cast<double>(file_.content.size());
  }
  [[noreturn]] void fail(const PlyPlace& place, const std::string& found,
                         const std::string& needed) const {
    file_.fail(found + " at byte " + std::to_string(at_) + place.words(), needed, ply_remedy);
  }

 private:
  template <typename Value>
  Value fetch(const PlyPlace& place) {
    if (file_.content.size() - at_ < sizeof(Value)) fail(place, "the end of the file", "a value");
    std::array<char, sizeof(Value)> bytes{};
    std::memcpy(bytes.data(), file_.content.data() + at_, sizeof(Value));
    at_ += sizeof(Value);
    if constexpr (swapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Value>(bytes);
  }

  const FileBytes& file_;
  std::size_t at_;
};

/// The number of items of the list that follows, small enough for the rest of the file.
template <typename Values>
std::int64_t list_length(Values& values, const PlyPlace& place) {
  const std::int64_t length = values.integer(place.property->count_type, place);
  if (length < 0 || !values.may_hold(place.property->type, length)) {
    values.fail(place, "a list of " + std::to_string(length) + " items",
                "a length that fits into the file");
  }
  return length;
}

/// An index in least .. vertices - 1.
template <typename Values>
std::int32_t vertex_index(Values& values, const PlyPlace& place, std::int64_t vertices,
                          std::int64_t least) {
  const std::int64_t vertex = values.integer(place.property->type, place);
  if (vertex < least || vertex >= vertices) {
    values.fail(place, "vertex index " + std::to_string(vertex),
                "an index from 0 to " + std::to_string(vertices - 1));
  }
  return static_cast<std::int32_t>(vertex);
}

/// A number that is finite.
template <typename Values>
double coordinate(Values& values, const PlyPlace& place) {
  const double value = values.number(place.property->type, place);
  if (!std::isfinite(value)) {
    values.fail(place, std::isnan(value) ? "NaN" : "infinity", "a finite number");
  }
  return value;
}

/// Calls `read(values)` with the reader for the header's encoding, set to the first element.
template <typename Read>
void with_ply_values(const FileBytes& file, const PlyHeader& header, const Read& read) {
  static_assert(std::endian::native == std::endian::little);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      return read(AsciiPlyValues(file, header.data_begin));
    case PlyEncoding::little_endian:
      return read(BinaryPlyValues<false>(file, header.data_begin));
    case PlyEncoding::big_endian:
      return read(BinaryPlyValues<true>(file, header.data_begin));
  }
}

}  // namespace curveskel
