#include "surface/read/ply_header.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

constexpr std::string_view correct_header = "correct the header or export the file again";

PlyType read_type(TextCursor& line) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 18> types{{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"int64", PlyType::int64},
      {"uint64", PlyType::uint64},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  line.skip_blanks();
  for (const auto& [name, type] : types) {
    if (line.accept(name)) return type;
  }
  line.fail("a type (char, uchar, short, ushort, int, uint, float, double)", correct_header);
}

std::string read_name(TextCursor& line, std::string_view needed) {
  line.skip_blanks();
  const std::string_view name = line.word();
  if (name.empty()) line.fail(needed, correct_header);
  return std::string(name);
}

PlyEncoding read_encoding(TextCursor& line) {
  line.skip_blanks();
  if (line.accept("ascii")) return PlyEncoding::ascii;
  if (line.accept("binary_little_endian")) return PlyEncoding::little_endian;
  if (line.accept("binary_big_endian")) return PlyEncoding::big_endian;
  line.fail("ascii, binary_little_endian or binary_big_endian", correct_header);
}

PlyElement read_element(TextCursor& line) {
  PlyElement element;
  element.name = read_name(line, "the name of an element");
  line.skip_blanks();
  const TextCursor start = line;
  element.count = line.integer("a number of rows");
  if (element.count < 0) start.fail("a number of rows", correct_header);
  return element;
}

PlyProperty read_property(TextCursor& line) {
  PlyProperty property;
  line.skip_blanks();
  property.is_list = line.accept("list");
  if (property.is_list) {
    line.skip_blanks();
    const TextCursor start = line;
    property.count_type = read_type(line);
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64) {
      start.fail("an integer type for the length of a list", correct_header);
    }
  }
  property.type = read_type(line);
  property.name = read_name(line, "the name of a property");
  return property;
}

/// A lying header must not make us allocate.
void check_counts(const FileBytes& file, const PlyHeader& header) {
  const auto left = static_cast<std::int64_t>(file.content.size() - header.data_begin) +
                    (header.encoding == PlyEncoding::ascii ? 1 : 0);  // a missing last line end
  std::int64_t needed = 0;
  for (const auto& element : header.elements) {
    const std::int64_t row = element.least_row_bytes(header.encoding);
    if (row > 0 && element.count > (left - needed) / row) {
      file.fail(std::to_string(element.count) + " rows of element \"" + element.name +
                    "\" announced but only " + std::to_string(left - needed) + " bytes left",
                "at least " + std::to_string(row) + " bytes per row",
                "the file is truncated or its header wrong: fetch or export it again");
    }
    needed += row * element.count;
  }
}

}  // namespace

std::size_t bytes_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64:
      return 8;
  }
  return 0;
}

std::int64_t PlyElement::least_row_bytes(PlyEncoding encoding) const {
  if (encoding == PlyEncoding::ascii) return 2 * static_cast<std::int64_t>(properties.size());
  std::int64_t bytes = 0;
  for (const auto& property : properties) {
    bytes +=
        static_cast<std::int64_t>(bytes_of(property.is_list ? property.count_type : property.type));
  }
  return bytes;
}

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.is_list; });
}

PlyHeader read_ply_header(const FileBytes& file) {
  PlyHeader header;
  // The lines of the header end as its first line does; the rest may be binary.
  const std::size_t first_end = std::min(file.content.find_first_of("\r\n"), file.content.size());
  const bool alone = file.content.substr(first_end, 2) != "\r\n" && file.content[first_end] == '\r';
  const char line_end = alone ? '\r' : '\n';
  TextCursor line(file, line_end);
  if (!line.accept("ply")) {
    line.fail("\"ply\"", "check that this is a PLY file, or name it by its format");
  }
  line.skip_line();
  bool encoded = false;
  for (;; line.skip_line()) {
    line.skip_blanks();
    if (line.done()) {
      line.fail("\"end_header\"", "the file is truncated: fetch or export it again");
    } else if (line.accept("format")) {
      header.encoding = read_encoding(line);
      encoded = true;
    } else if (line.accept("element")) {
      header.elements.push_back(read_element(line));
    } else if (line.accept("property")) {
      if (header.elements.empty()) line.fail("\"element\" before \"property\"", correct_header);
      header.elements.back().properties.push_back(read_property(line));
    } else if (line.accept("end_header")) {
      break;
    } else if (!line.at_line_end() && !line.accept("comment") && !line.accept("obj_info")) {
      line.fail("format, comment, obj_info, element, property or end_header", correct_header);
    }
  }
  if (!encoded) line.fail("a \"format\" line before \"end_header\"", correct_header);
  line.skip_line();
  header.data_begin = line.position();
  check_counts(file, header);
  return header;
}

}  // namespace curveskel
