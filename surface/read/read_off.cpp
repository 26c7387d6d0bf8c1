// Geomview's Object File Format. Prefixes of the keyword announce colours (C), normals (N) and
// texture coordinates (ST) behind each position; they are passed over with the rest of the line.
// Without them the rest of the line is passed over, too, where each vertex and face seems to have a
// line of its own; else numbers stand on any line.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "surface/read/formats.hpp"
#include "surface/read/off_keyword.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

struct OffCounts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  bool own_lines = true;  ///< for each vertex
};

/// Steps over the keyword, which may be missing altogether.
std::optional<OffKeyword> take_keyword(TextCursor& text) {
  text.skip_space('#');
  const TextCursor start = text;
  const auto keyword = parse_off_keyword(text.word());
  if (!keyword) {
    text = start;
    if (start.peek() < '0' || start.peek() > '9') {
      start.fail("\"OFF\", or the counts of vertices and faces",
                 "check that this is an OFF file, or name it by its format");
    }
  } else if (keyword->four_dimensional) {
    start.fail("positions in three dimensions", "project the surface to three dimensions first");
  }
  return keyword;
}

/// The place at which the numbers of a binary file begin; none of a text. Behind the keyword.
std::optional<std::size_t> begin_of_binary(TextCursor text) {
  text.skip_blanks();
  if (!text.accept("BINARY")) return std::nullopt;
  while (!text.at_line_end()) text.skip(1);
  return text.position() + (text.done() ? 0 : 1);
}

/// Nothing more on the line but blanks and a comment.
bool ends_line(TextCursor text) {
  text.skip_blanks();
  return text.at_line_end() || text.peek() == '#';
}

/// True if nothing but an integer stands on the next line that is not empty.
bool integer_alone(TextCursor text) {
  text.skip_space('#');
  const std::string_view word = text.word();
  const bool digits = !word.empty() && std::all_of(word.begin(), word.end(),
                                                   [](char c) { return c >= '0' && c <= '9'; });
  return digits && ends_line(text);
}

/// True if at least this many lines follow that are neither empty nor comments.
bool has_lines(TextCursor text, std::int64_t least) {
  for (std::int64_t lines = 0; lines < least; ++lines) {
    text.skip_space('#');
    if (text.done()) return false;
    text.skip_line();
  }
  return true;
}

std::int64_t words_on_line(TextCursor& text) {
  std::int64_t words = 0;
  for (; !ends_line(text); ++words) {
    text.skip_blanks();
    text.word();
  }
  return words;
}

/// True if as many lines as there are vertices, or to the end of the file, have equally many words:
/// a position and more behind it. The file's last line may be cut off.
bool has_rows(TextCursor text, std::int64_t vertices) {
  std::int64_t first = 0;
  for (std::int64_t row = 0; row < vertices; ++row) {
    text.skip_space('#');
    const std::int64_t words = words_on_line(text);
    text.skip_space('#');
    if (row == 0) first = words;
    if (text.done()) break;
    if (words != first) return false;
  }
  return first > 3 && first < 3 * vertices;
}

bool has_extras(const std::optional<OffKeyword>& keyword) {
  return keyword && (keyword->texture || keyword->colours || keyword->normals);
}

/// The number of edges, which many writers leave out or zero. `on_one_line`: the counts before it.
void skip_edges(TextCursor& text, bool on_one_line) {
  if (ends_line(text) && on_one_line && !integer_alone(text)) return;
  text.skip_space('#');
  text.word();
}

OffCounts read_header(TextCursor& text, const std::optional<OffKeyword>& keyword) {
  TextCursor start = text;
  if (keyword) {
    text.skip_space('#');
    const bool three = !keyword->any_dimensional || text.integer("the dimension") == 3;
    if (!three) {
      start.fail("positions in three dimensions", "project the surface to three dimensions first");
    }
  }

  OffCounts counts;
  text.skip_space('#');
  start = text;
  counts.vertices = text.integer("the number of vertices");
  const bool on_one_line = !ends_line(text);
  text.skip_space('#');
  counts.faces = text.integer("the number of faces");
  if (!has_extras(keyword)) skip_edges(text, on_one_line);
  TextCursor rest = text;
  rest.skip_line();
  if (has_extras(keyword) || ends_line(text)) text = rest;

  // "0 0 0\n" is the shortest vertex, "0\n" the shortest face.
  const auto left = static_cast<std::int64_t>(text.bytes_left()) + 1;
  if (counts.vertices < 0 || counts.faces < 0 || counts.vertices > left / 6 ||
      counts.faces > (left - 6 * counts.vertices) / 2) {
    start.fail("counts that fit into the " + std::to_string(left - 1) + " bytes that follow",
               "the header is wrong or the file truncated: export or fetch it again",
               std::to_string(counts.vertices) + " vertices and " + std::to_string(counts.faces) +
                   " faces announced");
  }
  counts.own_lines = has_extras(keyword) || has_lines(rest, counts.vertices + counts.faces) ||
                     has_rows(text, counts.vertices);
  if (counts.own_lines) text = rest;
  return counts;
}

void check_not_done(const TextCursor& text, std::int64_t row, std::int64_t rows,
                    std::string_view what) {
  if (!text.done()) return;
  text.fail(std::to_string(rows) + " " + std::string(what),
            "the file is truncated or its header wrong: fetch or export it again",
            "the end of the file after " + std::to_string(row));
}

void read_vertices(TextCursor& text, PolygonSoup& soup, bool own_lines, const Monitor& monitor) {
  constexpr std::array<std::string_view, 3> needed{"the x coordinate of a vertex",
                                                   "the y coordinate of a vertex",
                                                   "the z coordinate of a vertex"};
  for (Eigen::Index i = 0; i < soup.positions.rows(); ++i) {
    if (i % rows_per_report == 0) monitor.report("read", text.fraction());
    for (int k = 0; k < 3; ++k) {
      text.skip_space('#');
      if (k == 0) check_not_done(text, i, soup.positions.rows(), "vertices");
      soup.positions(i, k) = text.coordinate(needed[static_cast<std::size_t>(k)]);
    }
    if (own_lines) text.skip_line();
  }
}

void read_face(TextCursor& text, PolygonSoup& soup) {
  const TextCursor start = text;
  const std::int64_t corners = text.integer("the number of corners of a face");
  if (corners < 0 || corners > static_cast<std::int64_t>(text.bytes_left() / 2) + 1) {
    start.fail("the number of corners of a face", "correct it or export the file again");
  }
  for (std::int64_t k = 0; k < corners; ++k) {
    text.expect_word_end("an integer");
    text.skip_space('#');
    const TextCursor corner = text;
    const std::int64_t vertex = text.integer("a vertex index");
    if (vertex < 0 || vertex >= soup.positions.rows()) {
      corner.fail("a vertex index from 0 to " + std::to_string(soup.positions.rows() - 1),
                  "OFF counts vertices from 0; export the file again");
    }
    soup.corners.push_back(static_cast<std::int32_t>(vertex));
  }
  text.expect_word_end("an integer");
  end_polygon(soup);
}

}  // namespace

PolygonSoup read_off(const FileBytes& file, const Monitor& monitor) {
  PolygonSoup soup;
  soup.format = SurfaceFormat::off;
  TextCursor text(file);
  const auto keyword = take_keyword(text);
  if (const auto begin = keyword ? begin_of_binary(text) : std::nullopt) {
    if (keyword->any_dimensional) {
      text.fail("positions in three dimensions", "convert it to text or PLY first", "binary nOFF");
    }
    return read_binary_off(file, *begin, *keyword, monitor);
  }
  const OffCounts counts = read_header(text, keyword);
  if (counts.vertices > most_vertices) {
    file.fail(std::to_string(counts.vertices) + " vertices",
              "at most " + std::to_string(most_vertices), "split or decimate the surface first");
  }
  soup.positions.resize(counts.vertices, 3);
  read_vertices(text, soup, counts.own_lines, monitor);
  const bool own_lines = counts.own_lines || has_lines(text, counts.faces);
  soup.offsets.reserve(static_cast<std::size_t>(counts.faces) + 1);
  soup.corners.reserve(static_cast<std::size_t>(counts.faces) * 3);
  soup.offsets.push_back(0);
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    if (i % rows_per_report == 0) monitor.report("read", text.fraction());
    text.skip_space('#');
    check_not_done(text, i, counts.faces, "faces");
    read_face(text, soup);
    if (own_lines) text.skip_line();  // colours
  }
  return soup;
}

bool looks_like_off(const FileBytes& file) {
  TextCursor text(file);
  text.skip_space('#');
  return parse_off_keyword(text.word()).has_value();
}

}  // namespace curveskel
