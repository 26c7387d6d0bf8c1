// Stereolithography, binary and ASCII. Every facet brings its own corners; `clean` joins them.
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/file_names.hpp>
#include "surface/read/formats.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

constexpr std::size_t preamble_bytes = 84;  // 80 of any text, 4 of the number of facets
constexpr std::size_t facet_bytes = 50;     // normal, three corners, two bytes of attributes

/// As its four bytes have it.
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
  return in_lower_case(text.word().substr(0, 16));
}

bool begins_comment(const TextCursor& text) { return text.peek() == ';' || text.peek() == '#'; }

void skip_comments(TextCursor& text) {
  for (text.skip_space(0); begins_comment(text); text.skip_space(0)) text.skip_line();
}

/// True at "facet" if what follows on the line is no name.
bool begins_facet(TextCursor text) {
  if (lower_word(text) != "facet") return false;
  const std::string next = lower_word(text);
  return next.empty() || next == "normal" || next == "outer";
}

/// To the end of the line or the facet that begins on it.
void skip_name(TextCursor& text) {
  for (text.skip_blanks(); !text.at_line_end() && !begins_facet(text); text.skip_blanks()) {
    text.word();
  }
}

/// "solid" first, and then a facet or an end; the name may have lines of its own.
bool has_ascii_start(const FileBytes& file) {
  constexpr std::size_t first_lines = 1000;
  TextCursor text(file);
  skip_comments(text);
  if (lower_word(text) != "solid") return false;
  for (skip_name(text); text.position() < first_lines; skip_name(text)) {
    skip_comments(text);
    TextCursor next = text;
    const std::string word = lower_word(next);
    if (text.done() || begins_facet(text) || word == "endsolid" || word == "solid") return true;
  }
  return false;
}

/// Some writers leave the count at 0, or at the first part's: what is there counts if the file ends
/// with a whole facet.
std::size_t facets_to_read(const FileBytes& file, const Monitor& monitor) {
  const std::size_t announced = facets_announced(file);
  const std::size_t bytes = file.content.size() - preamble_bytes;
  const std::size_t there = bytes / facet_bytes;
  if (bytes % facet_bytes != 0 || there <= announced) return announced;
  monitor.say(file.path.string() + ": announces " + std::to_string(announced) + " facets and has " +
              std::to_string(there) + ", which are all read");
  return there;
}

PolygonSoup read_binary(const FileBytes& file, const Monitor& monitor) {
  const std::size_t size = file.content.size();
  if (size < preamble_bytes) {
    file.fail(std::to_string(size) + " bytes that are no ASCII STL",
              "at least " + std::to_string(preamble_bytes) + " bytes of a binary STL",
              "check that this is an STL file, or fetch it again");
  }
  const std::size_t facets = facets_to_read(file, monitor);
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

/// The facets of a text, word by word: lines mean nothing but the end of a name. "facet normal" and
/// "outer loop" carry nothing that the corners do not say.
class AsciiReader {
 public:
  explicit AsciiReader(const FileBytes& file) : text_(file) {}

  PolygonSoup read(const Monitor& monitor) {
    std::size_t row = 0;
    for (skip_comments(text_); !text_.done(); skip_comments(text_), ++row) {
      if (row % rows_per_report == 0) monitor.report("read", text_.fraction());
      read_word();
    }
    if (!open_.empty()) {
      text_.fail("\"" + open_ + "\"", "the file is truncated: fetch or export it again");
    }
    PolygonSoup soup;
    soup.positions = positions_from(coordinates_);
    return soup;
  }

 private:
  static constexpr std::string_view correct_it = "correct it or export the file again";

  void read_word() {
    const TextCursor start = text_;
    const std::string word = lower_word(text_);
    const bool in_facet = open_ == "endfacet";
    const bool of_solid = word == "facet" || word == "solid" || word == "endsolid";
    if (in_facet ? of_solid : word == "vertex") {
      start.fail(in_facet ? "\"endfacet\" first" : "\"facet\" before \"vertex\"", correct_it);
    }
    if (word == "vertex") {
      text_.read_vertex(coordinates_);
      skip_rest();
    } else if (word == "facet") {
      facet_begin_ = coordinates_.size();
      open_ = "endfacet";
      in_name_ = false;
      skip_rest();
    } else if (word == "endfacet") {
      end_facet(start);
    } else if (of_solid) {
      open_ = word == "solid" ? "endsolid" : "";
      in_name_ = word == "solid";
      skip_name(text_);
    } else if (word == "outer" || word == "endloop" || word == "color") {
      skip_rest();
    } else if (in_name_) {
      skip_name(text_);
    } else {
      start.fail("solid, facet, outer loop, vertex, endloop, endfacet or endsolid", correct_it);
    }
  }

  void end_facet(const TextCursor& start) {
    if (open_ != "endfacet" || coordinates_.size() != facet_begin_ + 9) {
      start.fail("\"facet\" and three vertices before \"endfacet\"", correct_it,
                 std::to_string((coordinates_.size() - facet_begin_) / 3) + " vertices");
    }
    open_ = "endsolid";
    skip_rest();
  }

  /// To the end of the line or the next of the format's words on it.
  void skip_rest() {
    constexpr std::string_view first_letters = "fovesFOVES";
    constexpr std::array<std::string_view, 7> words{"facet",    "outer",    "vertex", "endloop",
                                                    "endfacet", "endsolid", "solid"};
    for (text_.skip_blanks(); !text_.at_line_end(); text_.skip_blanks()) {
      if (begins_comment(text_)) return;
      TextCursor next = text_;
      if (first_letters.find(text_.peek()) == std::string_view::npos) {
        text_.word();
      } else if (std::find(words.begin(), words.end(), lower_word(next)) != words.end()) {
        return;
      } else {
        text_ = next;
      }
    }
  }

  TextCursor text_;
  std::vector<double> coordinates_;
  std::string open_;  // the block still to be closed
  std::size_t facet_begin_ = 0;
  bool in_name_ = false;  // of a solid, before its first facet
};

}  // namespace

PolygonSoup read_stl(const FileBytes& file, const Monitor& monitor) {
  const bool ascii = !has_binary_size(file) && has_ascii_start(file);
  PolygonSoup soup = ascii ? AsciiReader(file).read(monitor) : read_binary(file, monitor);
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
