// VTK's legacy format, PolyData only: text, or big-endian numbers between lines of text; cells with
// their sizes (up to version 4.2) or as offsets and connectivity (from 5.0 on).
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/file_names.hpp>
#include "surface/read/binary_cursor.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/text_cursor.hpp"
#include "surface/read/triangle_strip.hpp"

namespace curveskel {
namespace {

constexpr std::string_view vtk_start = "# vtk DataFile Version";
constexpr std::string_view vtk_remedy = "the file is truncated or broken: fetch or export it again";

enum class VtkType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct VtkTypeName {
  std::string_view name;
  VtkType type;
};

constexpr std::array<VtkTypeName, 16> vtk_types{{{"float", VtkType::float32},
                                                 {"double", VtkType::float64},
                                                 {"int", VtkType::int32},
                                                 {"unsigned_int", VtkType::uint32},
                                                 {"vtkidtype", VtkType::int32},
                                                 {"vtktypeint64", VtkType::int64},
                                                 {"vtktypeuint64", VtkType::uint64},
                                                 {"vtktypeint32", VtkType::int32},
                                                 {"vtktypeuint32", VtkType::uint32},
                                                 {"long", VtkType::int64},
                                                 {"unsigned_long", VtkType::uint64},
                                                 {"short", VtkType::int16},
                                                 {"unsigned_short", VtkType::uint16},
                                                 {"char", VtkType::int8},
                                                 {"unsigned_char", VtkType::uint8},
                                                 {"signed_char", VtkType::int8}}};

/// True if the next word is this keyword, given in lower case; if so it is stepped over. VTK reads
/// its keywords and names of types in any case.
bool accept_keyword(TextCursor& text, std::string_view keyword) {
  TextCursor next = text;
  if (in_lower_case(next.word()) != keyword) return false;
  text = next;
  return true;
}

double take_number(BinaryCursor& bytes, VtkType type) {
  switch (type) {
    case VtkType::int8:
      return bytes.take<std::int8_t>();
    case VtkType::uint8:
      return bytes.take<std::uint8_t>();
    case VtkType::int16:
      return bytes.take<std::int16_t>();
    case VtkType::uint16:
      return bytes.take<std::uint16_t>();
    case VtkType::int32:
      return bytes.take<std::int32_t>();
    case VtkType::uint32:
      return bytes.take<std::uint32_t>();
    case VtkType::int64:
      return static_cast<double>(bytes.take<std::int64_t>());
    case VtkType::uint64:
      return static_cast<double>(bytes.take<std::uint64_t>());
    case VtkType::float32:
      return static_cast<double>(bytes.take<float>());
    case VtkType::float64:
      return bytes.take<double>();
  }
  return 0;
}

class VtkReader {
 public:
  VtkReader(const FileBytes& file, const Monitor& monitor)
      : file_(file), monitor_(monitor), text_(file, '\n') {
    soup_.format = SurfaceFormat::vtk;
    soup_.offsets.push_back(0);
  }

  PolygonSoup read() {
    read_header();
    for (text_.skip_space(0); !text_.done(); text_.skip_space(0)) {
      if (!read_section()) break;
    }
    check_corners();
    soup_.positions = positions_from(coordinates_);
    return std::move(soup_);
  }

 private:
  void read_header() {
    text_.skip_line();
    text_.skip_line();  // the title
    text_.skip_space(0);
    binary_ = accept_keyword(text_, "binary");
    if (!binary_ && !accept_keyword(text_, "ascii"))
      text_.fail("\"ASCII\" or \"BINARY\"", vtk_remedy);
    text_.skip_space(0);
    if (accept_keyword(text_, "field")) skip_fields();
    text_.skip_space(0);
    if (!accept_keyword(text_, "dataset")) text_.fail("\"DATASET\"", vtk_remedy);
    text_.skip_blanks();
    if (!accept_keyword(text_, "polydata")) {
      text_.fail("POLYDATA",
                 "extract its surface, in ParaView by Filters, Extract Surface, and save that as "
                 ".vtp or .ply");
    }
  }

  /// False where what describes the surface ends.
  bool read_section() {
    const TextCursor start = text_;
    monitor_.report("read", text_.fraction());
    const std::string name = in_lower_case(text_.word());
    if (name == "points") {
      read_points();
    } else if (name == "polygons") {
      read_cells(Cells::polygons);
    } else if (name == "triangle_strips") {
      read_cells(Cells::strips);
    } else if (name == "vertices" || name == "lines") {
      read_cells(Cells::passed_over);
    } else if (name == "metadata") {
      skip_metadata();
    } else if (name == "field") {
      skip_fields();
    } else if (name == "point_data" || name == "cell_data") {
      return false;
    } else {
      start.fail("POINTS, POLYGONS, TRIANGLE_STRIPS or data", vtk_remedy);
    }
    return true;
  }

  [[nodiscard]] std::size_t count(std::string_view needed) {
    text_.skip_blanks();
    const TextCursor start = text_;
    const std::int64_t value = text_.integer(needed);
    if (value < 0 || value > static_cast<std::int64_t>(file_.content.size())) {
      start.fail(std::string(needed) + " that fits into the file", vtk_remedy);
    }
    return static_cast<std::size_t>(value);
  }

  [[nodiscard]] VtkType type() {
    text_.skip_blanks();
    const TextCursor start = text_;
    const std::string word = in_lower_case(text_.word());
    for (const VtkTypeName& known : vtk_types) {
      if (known.name == word) return known.type;
    }
    start.fail("a type of numbers", vtk_remedy);
  }

  /// `values` numbers behind the end of this line.
  [[nodiscard]] std::vector<double> numbers(std::size_t values, VtkType type,
                                            std::string_view needed) {
    std::vector<double> result;
    text_.skip_line();
    if (binary_) {
      BinaryCursor bytes(file_, text_.position(), std::endian::big);
      bytes.require(values);
      result.reserve(values);
      for (std::size_t i = 0; i < values; ++i) result.push_back(take_number(bytes, type));
      text_.skip(bytes.place() - text_.position());
    } else {
      for (std::size_t i = 0; i < values; ++i) {
        text_.skip_space(0);
        result.push_back(text_.coordinate(needed));
      }
    }
    return result;
  }

  void read_points() {
    const TextCursor start = text_;
    const std::size_t points = count("the number of points");
    const VtkType of = type();
    if (!coordinates_.empty()) start.fail("points once", vtk_remedy);
    coordinates_ = numbers(3 * points, of, "a coordinate");
  }

  enum class Cells { polygons, strips, passed_over };

  void read_cells(Cells kind) {
    const TextCursor start = text_;
    const std::size_t cells = count("the number of cells");
    const std::size_t size = count("the size of the list of cells");
    TextCursor next = text_;
    next.skip_line();
    next.skip_space(0);
    std::vector<double> ends;
    std::vector<double> corners;
    if (accept_keyword(next, "offsets")) {
      text_ = next;
      const VtkType of_offsets = type();
      ends = numbers(cells, of_offsets, "an offset");
      text_.skip_space(0);
      if (!accept_keyword(text_, "connectivity")) text_.fail("\"CONNECTIVITY\"", vtk_remedy);
      const VtkType of_corners = type();
      corners = numbers(size, of_corners, "a point index");
    } else {
      const std::vector<double> list = numbers(size, VtkType::int32, "a point index");
      ends.push_back(0);
      for (std::size_t at = 0; at < list.size();) {
        const double length = list[at++];
        if (!(length >= 0 && length <= static_cast<double>(list.size() - at))) {
          start.fail("the sizes of cells that fit into their list", vtk_remedy,
                     "a cell of " + std::to_string(length) + " points");
        }
        for (auto k = static_cast<std::size_t>(length); k > 0; --k) corners.push_back(list[at++]);
        ends.push_back(static_cast<double>(corners.size()));
      }
    }
    if (kind != Cells::passed_over) append_cells(start, kind, ends, corners);
  }

  void append_cells(const TextCursor& start, Cells kind, const std::vector<double>& ends,
                    const std::vector<double>& corners) {
    std::vector<std::int32_t> vertices;
    vertices.reserve(corners.size());
    for (const double corner : corners) {
      if (!(corner >= 0 && corner < static_cast<double>(most_vertices) &&
            std::floor(corner) == corner)) {
        start.fail("whole numbers from 0 on", vtk_remedy,
                   "the point index " + std::to_string(corner));
      }
      vertices.push_back(static_cast<std::int32_t>(corner));
    }
    for (std::size_t c = 1; c < ends.size(); ++c) {
      if (!(ends[c - 1] >= 0 && ends[c - 1] <= ends[c] &&
            ends[c] <= static_cast<double>(vertices.size()))) {
        start.fail("ascending offsets up to " + std::to_string(vertices.size()), vtk_remedy,
                   "an offset that runs backwards or past the connectivity");
      }
      const auto begin = static_cast<std::size_t>(ends[c - 1]);
      const std::span cell(vertices.data() + begin, static_cast<std::size_t>(ends[c]) - begin);
      if (kind == Cells::strips) {
        append_strip(cell, soup_);
      } else {
        soup_.corners.insert(soup_.corners.end(), cell.begin(), cell.end());
        end_polygon(soup_);
      }
    }
  }

  /// Up to the next empty line.
  void skip_metadata() {
    do {
      text_.skip_line();
      text_.skip_blanks();
    } while (!text_.at_line_end());
  }

  void skip_fields() {
    text_.skip_blanks();
    text_.word();
    const std::size_t arrays = count("the number of arrays");
    for (std::size_t a = 0; a < arrays; ++a) {
      text_.skip_space(0);
      if (accept_keyword(text_, "metadata")) {
        skip_metadata();
        text_.skip_space(0);
      }
      text_.word();
      const std::size_t components = count("the number of components");
      const std::size_t rows = count("the number of rows");
      if (rows > 0 && components > file_.content.size() / rows) {
        text_.fail("an array that fits into the file", vtk_remedy);
      }
      skip_array(components * rows);
    }
  }

  /// Arrays of fields may be of strings and bits, too.
  void skip_array(std::size_t values) {
    text_.skip_blanks();
    if (accept_keyword(text_, "string")) return skip_strings(values);
    if (binary_ && accept_keyword(text_, "bit")) {
      (void)numbers((values + 7) / 8, VtkType::uint8, "bits");
    } else if (accept_keyword(text_, "bit")) {
      (void)numbers(values, VtkType::uint8, "a bit");
    } else {
      const VtkType of = type();
      (void)numbers(values, of, "a number");
    }
  }

  /// A line for each, or in binary files the length before it: two bits tell how many bytes it has.
  void skip_strings(std::size_t strings) {
    text_.skip_line();
    for (std::size_t s = 0; s < strings; ++s) {
      if (!binary_) {
        text_.skip_line();
        continue;
      }
      BinaryCursor bytes(file_, text_.position(), std::endian::big);
      bytes.require(1);
      const auto first = bytes.take<std::uint8_t>();
      const std::size_t more = (std::size_t{8} >> (first >> 6U)) - 1;
      bytes.require(more);
      std::size_t length = first & 0x3FU;
      for (std::size_t k = 0; k < more; ++k) length = length << 8U | bytes.take<std::uint8_t>();
      bytes.require(length);
      text_.skip(bytes.place() + length - text_.position());
    }
  }

  void check_corners() const {
    const auto points = static_cast<std::int32_t>(coordinates_.size() / 3);
    for (const std::int32_t corner : soup_.corners) {
      if (corner >= points) {
        file_.fail("the point index " + std::to_string(corner),
                   "indices from 0 to " + std::to_string(points) + " - 1", vtk_remedy);
      }
    }
  }

  const FileBytes& file_;
  const Monitor& monitor_;
  TextCursor text_;
  bool binary_ = false;
  PolygonSoup soup_;
  std::vector<double> coordinates_;
};

}  // namespace

PolygonSoup read_vtk(const FileBytes& file, const Monitor& monitor) {
  return VtkReader(file, monitor).read();
}

bool looks_like_vtk(const FileBytes& file) { return file.content.starts_with(vtk_start); }

}  // namespace curveskel
