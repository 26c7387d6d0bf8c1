// Stereolithography, binary and ASCII. Every facet brings its own corners; `clean` joins them.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/formats.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

constexpr std::size_t preamble_bytes = 84;  // 80 of any text, 4 of the number of facets
constexpr std::size_t facet_bytes = 50;     // normal, three corners, two bytes of attributes

std::uint32_t facets_announced(const FileBytes& file) {
  std::uint32_t facets = 0;
  std::memcpy(&facets, file.content.data() + preamble_bytes - 4, sizeof facets);
  return facets;
}

/// The size tells a binary file, even if its header begins with "solid".
bool has_binary_size(const FileBytes& file) {
  return file.content.size() >= preamble_bytes &&
         file.content.size() == preamble_bytes + facet_bytes * facets_announced(file);
}

std::string lower_word(TextCursor& text) {
  text.skip_blanks();
  std::string word(text.word().substr(0, 16));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// "solid" on the first line and one of the format's words on the next one that is not empty.
bool has_ascii_start(const FileBytes& file) {
  TextCursor text(file);
  text.skip_space(0);
  if (lower_word(text) != "solid") return false;
  text.skip_line();
  text.skip_space(0);
  const std::string next = lower_word(text);
  return text.done() || next == "facet" || next == "endsolid" || next == "solid";
}

PolygonSoup read_binary(const FileBytes& file, const Monitor& monitor) {
  const std::size_t size = file.content.size();
  if (size < preamble_bytes) {
    file.fail(std::to_string(size) + " bytes that are no ASCII STL",
              "at least " + std::to_string(preamble_bytes) + " bytes of a binary STL",
              "check that this is an STL file, or fetch it again");
  }
  const std::size_t facets = facets_announced(file);
  if (facets > (size - preamble_bytes) / facet_bytes) {
    file.fail(std::to_string(facets) + " facets announced in " + std::to_string(size) + " bytes",
              std::to_string(preamble_bytes + facet_bytes * facets) + " bytes for them",
              "the file is truncated or no STL: fetch or export it again");
  }
  if (3 * facets > static_cast<std::size_t>(most_vertices)) {
    file.fail(std::to_string(facets) + " facets", "at most " + std::to_string(most_vertices / 3),
              "split or decimate the surface first");
  }
  PolygonSoup soup;
  soup.positions.resize(static_cast<Eigen::Index>(3 * facets), 3);
  double* coordinate = soup.positions.data();
  for (std::size_t facet = 0; facet < facets; ++facet) {
    if (facet % rows_per_report == 0) {
      monitor.report("read", static_cast<double>(facet) / static_cast<double>(facets));
    }
    std::array<float, 9> values{};
    const char* const data = file.content.data() + preamble_bytes + facet_bytes * facet;
    std::memcpy(values.data(), data + 3 * sizeof(float), sizeof values);
    for (const float value : values) *coordinate++ = static_cast<double>(value);
  }
  return soup;
}

/// "facet normal" and "outer loop" carry nothing that the corners do not say.
PolygonSoup read_ascii(const FileBytes& file, const Monitor& monitor) {
  std::vector<double> coordinates;
  TextCursor text(file);
  std::string open;  // the blocks still to be closed, outermost first
  std::size_t facet_begin = 0;
  for (std::size_t row = 0; text.skip_space(0), !text.done(); text.skip_line(), ++row) {
    if (row % rows_per_report == 0) monitor.report("read", text.fraction());
    const TextCursor start = text;
    const std::string word = lower_word(text);
    const bool in_facet = open == "endfacet";
    const bool of_solid = word == "facet" || word == "solid" || word == "endsolid";
    if (in_facet ? of_solid : word == "vertex") {
      start.fail(in_facet ? "\"endfacet\" first" : "\"facet\" before \"vertex\"",
                 "correct it or export the file again");
    } else if (word == "vertex") {
      text.read_vertex(coordinates);
    } else if (word == "facet") {
      facet_begin = coordinates.size();
      open = "endfacet";
    } else if (word == "endfacet") {
      if (open != word || coordinates.size() != facet_begin + 9) {
        start.fail("\"facet\" and three vertices before \"endfacet\"",
                   "correct it or export the file again",
                   std::to_string((coordinates.size() - facet_begin) / 3) + " vertices");
      }
      open = "endsolid";
    } else if (word == "solid") {
      open = "endsolid";
    } else if (word == "endsolid") {
      open.clear();
    } else if (word != "outer" && word != "endloop" && word != "color") {
      start.fail("solid, facet, outer loop, vertex, endloop, endfacet or endsolid",
                 "correct it or export the file again");
    }
  }
  if (!open.empty()) {
    text.fail("\"" + open + "\"", "the file is truncated: fetch or export it again");
  }
  PolygonSoup soup;
  soup.positions = positions_from(coordinates);
  return soup;
}

}  // namespace

PolygonSoup read_stl(const FileBytes& file, const Monitor& monitor) {
  const bool ascii = !has_binary_size(file) && has_ascii_start(file);
  PolygonSoup soup = ascii ? read_ascii(file, monitor) : read_binary(file, monitor);
  soup.format = SurfaceFormat::stl;
  const auto corners = static_cast<std::size_t>(soup.positions.rows());
  soup.corners.resize(corners);
  for (std::size_t i = 0; i < corners; ++i) soup.corners[i] = static_cast<std::int32_t>(i);
  soup.offsets.resize(corners / 3 + 1);
  for (std::size_t i = 0; i <= corners / 3; ++i) {
    soup.offsets[i] = static_cast<std::int64_t>(3 * i);
  }
  return soup;
}

bool looks_like_stl(const FileBytes& file) {
  return has_binary_size(file) || has_ascii_start(file);
}

}  // namespace curveskel
