// Wavefront OBJ: vertices and faces; everything else (texture, normals, groups, materials, curves)
// is passed over.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/formats.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

/// Under its old name, too.
bool accept_face(TextCursor& text) { return text.accept("f") || text.accept("fo"); }

constexpr std::string_view index_remedy =
    "OBJ counts vertices from 1, or from -1 backwards; export the file again";

/// Corners are v, v/vt, v//vn or v/vt/vn; only v is kept.
void read_face(TextCursor& text, std::int64_t vertices, PolygonSoup& soup) {
  for (text.skip_blanks(); !text.at_line_end() && text.peek() != '#'; text.skip_blanks()) {
    const TextCursor start = text;
    const std::int64_t index = text.integer("a vertex index");
    const std::int64_t vertex = index < 0 ? vertices + index : index - 1;
    if (index == 0 || vertex < 0 || vertex >= most_vertices) {
      start.fail("a vertex index that exists (" + std::to_string(vertices) + " vertices so far)",
                 index_remedy);
    }
    if (text.peek() == '/') {
      text.word();
    } else {
      text.expect_word_end("a vertex index");
    }
    soup.corners.push_back(static_cast<std::int32_t>(vertex));
  }
  end_polygon(soup);
}

/// Counts of elements that are no polygons.
struct OtherElements {
  std::int64_t lines = 0;
  std::int64_t free_forms = 0;
};

void refuse_without_faces(const FileBytes& file, const OtherElements& others) {
  if (others.free_forms > 0) {
    file.fail("free-form surfaces: " + std::to_string(others.free_forms) +
                  " of them (\"surf\") and no faces",
              "polygons", "export it as a mesh, in the program that wrote it");
  }
  if (others.lines > 0) {
    file.fail("a skeleton or a drawing of lines: " + std::to_string(others.lines) +
                  (others.lines == 1 ? " line" : " lines") + " (\"l\") and no faces",
              "a surface with faces", "give the surface, of which a skeleton can be made");
  }
}

/// A face may come before its vertices, so the upper bound can be checked at the end only; the
/// line is then found by going through the file once more.
void check_indices(const FileBytes& file, const PolygonSoup& soup) {
  const auto vertices = static_cast<std::int32_t>(soup.positions.rows());
  const auto bad = std::find_if(soup.corners.begin(), soup.corners.end(),
                                [&](std::int32_t corner) { return corner >= vertices; });
  if (bad == soup.corners.end()) return;
  const auto polygon = std::upper_bound(soup.offsets.begin(), soup.offsets.end(),
                                        static_cast<std::int64_t>(bad - soup.corners.begin())) -
                       soup.offsets.begin() - 1;
  TextCursor text(file);
  for (std::int64_t faces = 0; !text.done(); text.skip_continued_line()) {
    text.skip_blanks();
    if (accept_face(text) && faces++ == polygon) break;
  }
  text.fail("a vertex index of at most " + std::to_string(vertices), index_remedy,
            "vertex " + std::to_string(std::int64_t{*bad} + 1));
}

}  // namespace

PolygonSoup read_obj(const FileBytes& file, const Monitor& monitor) {
  PolygonSoup soup;
  soup.format = SurfaceFormat::obj;
  soup.offsets.push_back(0);
  std::vector<double> coordinates;
  OtherElements others;
  TextCursor text(file);
  for (std::int64_t row = 0; !text.done(); ++row) {
    if (row % rows_per_report == 0) monitor.report("read", text.fraction());
    text.skip_blanks();
    if (text.accept("v")) {
      text.read_vertex(coordinates);
    } else if (accept_face(text)) {
      read_face(text, static_cast<std::int64_t>(coordinates.size() / 3), soup);
    } else if (text.peek() == '#') {
      text.skip_line();
      continue;
    } else if (text.accept("l")) {
      ++others.lines;
    } else if (text.accept("surf")) {
      ++others.free_forms;
    }
    text.skip_continued_line();
  }
  if (static_cast<std::int64_t>(coordinates.size() / 3) > most_vertices) {
    file.fail(std::to_string(coordinates.size() / 3) + " vertices",
              "at most " + std::to_string(most_vertices), "split or decimate the surface first");
  }
  if (coordinates.empty() && soup.corners.empty()) {
    file.fail("no line that begins with \"v\" or \"f\" in what begins with " +
                  in_quotes(file.content.substr(0, 41)),
              "vertices and faces of an OBJ file",
              "check the file's content, or name it by its format");
  }
  if (soup.corners.empty()) refuse_without_faces(file, others);
  soup.positions = positions_from(coordinates);
  check_indices(file, soup);
  return soup;
}

bool looks_like_obj(const FileBytes& file) {
  constexpr std::array<std::string_view, 9> keywords{"v", "vt", "vn",     "f",     "o",
                                                     "g", "s",  "mtllib", "usemtl"};
  TextCursor text(file);
  text.skip_space('#');
  return std::any_of(keywords.begin(), keywords.end(), [&](std::string_view keyword) {
    TextCursor here = text;
    return here.accept(keyword) && here.peek() != 0;
  });
}

}  // namespace curveskel
