// The plain text formats: OBJ, CGAL polylines, SWC.
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "skeleton/io/raw_graph.hpp"
#include "surface/read/text_cursor.hpp"

namespace curveskel {
namespace {

constexpr std::string_view correct_it = "correct it or export the file again";

double next_number(TextCursor& text, std::string_view needed) {
  text.skip_blanks();
  return text.number(needed);
}

std::int64_t next_integer(TextCursor& text, std::string_view needed) {
  text.skip_blanks();
  const TextCursor start = text;
  const std::int64_t value = text.integer(needed);
  if (!text.at_line_end() && text.peek() != ' ' && text.peek() != '\t' && text.peek() != '\r') {
    start.fail(needed, correct_it);
  }
  return value;
}

Eigen::RowVector3d next_point(TextCursor& text) {
  constexpr std::array<std::string_view, 3> needed{
      "the x coordinate of a point", "the y coordinate of a point", "the z coordinate of a point"};
  Eigen::RowVector3d point;
  for (Eigen::Index k = 0; k < 3; ++k) {
    point(k) = next_number(text, needed[static_cast<std::size_t>(k)]);
  }
  return point;
}

/// The vertices of an l or a p, each v or v/vt.
std::vector<int> obj_vertices(TextCursor& text, std::size_t vertices) {
  std::vector<int> chain;
  const auto count = static_cast<std::int64_t>(vertices);
  for (text.skip_blanks(); !text.at_line_end() && text.peek() != '#'; text.skip_blanks()) {
    const TextCursor start = text;
    const std::int64_t index = text.integer("a vertex index");
    const std::int64_t vertex = index < 0 ? count + index : index - 1;
    if (vertex < 0 || vertex >= count) {
      start.fail("a vertex index that exists (" + std::to_string(count) + " vertices so far)",
                 "OBJ counts vertices from 1, or from -1 backwards; export the file again");
    }
    if (text.peek() == '/') text.word();
    text.expect_word_end("a vertex index");
    chain.push_back(static_cast<int>(vertex));
  }
  return chain;
}

/// "# cut 3 17" and "# no radius 3 17", which this program writes; whatever else comments say is
/// none of our business.
struct SwcComments {
  std::vector<std::pair<std::int64_t, std::int64_t>> cuts;
  std::vector<std::int64_t> without_radius;

  void read(TextCursor& text) {
    text.skip(1);
    text.skip_blanks();
    const bool cut = text.accept("cut");
    if (!cut && !text.accept("no")) return;
    text.skip_blanks();
    if (!cut && !text.accept("radius")) return;
    std::vector<std::int64_t> samples;
    for (text.skip_blanks(); !text.at_line_end(); text.skip_blanks()) {
      const std::string_view word = text.word();
      std::int64_t sample = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), sample);
      if (error != std::errc() || end != word.data() + word.size()) return;
      samples.push_back(sample);
    }
    if (cut && samples.size() == 2) cuts.emplace_back(samples[0], samples[1]);
    if (!cut) without_radius.insert(without_radius.end(), samples.begin(), samples.end());
  }
};

}  // namespace

RawGraph read_obj_lines(const FileBytes& file) {
  RawGraph graph;
  bool faces = false;
  for (TextCursor text(file); !text.done();) {
    text.skip_blanks();
    if (text.accept("v")) {
      graph.add(next_point(text));
    } else if (text.accept("l")) {
      graph.add_chain(obj_vertices(text, graph.points.size()));
    } else if (text.accept("p")) {
      for (const int vertex : obj_vertices(text, graph.points.size())) {
        graph.alone.push_back(vertex);
      }
    } else if (text.peek() == '#') {
      text.skip_line();  // a backslash at its end continues nothing
      continue;
    } else {
      faces = faces || text.accept("f");
    }
    text.skip_continued_line();
  }
  if (graph.edges.empty() && graph.alone.empty()) {
    file.fail(faces ? "faces and no lines (l)" : "no lines (l)", "the lines of a skeleton",
              faces ? "this is a surface: give the skeleton's file" : "export the skeleton again");
  }
  return graph;
}

RawGraph read_polylines(const FileBytes& file) {
  RawGraph graph;
  TextCursor text(file);
  for (text.skip_space('#'); !text.done(); text.skip_space('#')) {
    const TextCursor start = text;
    const std::int64_t count = next_integer(text, "the number of points of a polyline");
    if (count < 1 || count > static_cast<std::int64_t>(text.bytes_left())) {
      start.fail("the number of points of a polyline, 1 or more, that follow", correct_it);
    }
    std::vector<int> chain;
    for (std::int64_t k = 0; k < count; ++k) {
      Eigen::RowVector3d point;
      for (double& value : point) {
        text.skip_space(0);
        value = text.number("a coordinate of point " + std::to_string(k + 1) + " of " +
                            std::to_string(count));
      }
      chain.push_back(graph.add(point));
    }
    graph.add_chain(chain);
  }
  return graph;
}

RawGraph read_swc(const FileBytes& file) {
  RawGraph graph;
  SwcComments comments;
  std::unordered_map<std::int64_t, int> point_of;
  struct Link {
    int point;
    std::int64_t parent;
    TextCursor at;
  };
  std::vector<Link> links;
  for (TextCursor text(file); !text.done(); text.skip_line()) {
    text.skip_blanks();
    if (text.peek() == '#') {
      comments.read(text);
      continue;
    }
    if (text.at_line_end()) continue;
    const TextCursor start = text;
    const std::int64_t id = next_integer(text, "the number of a sample");
    next_integer(text, "the type of a sample");
    const Eigen::RowVector3d position = next_point(text);
    const double radius = next_number(text, "the radius of a sample");
    text.skip_blanks();
    const TextCursor parent_at = text;
    const std::int64_t parent = next_integer(text, "the parent of a sample (-1 = none)");
    const int point = graph.add(position, radius);
    if (!point_of.emplace(id, point).second) {
      start.fail("the number of a sample that is not used above", correct_it);
    }
    links.push_back({point, parent, parent_at});
  }
  for (const Link& link : links) {
    graph.alone.push_back(link.point);
    if (link.parent < 0) continue;
    const auto parent = point_of.find(link.parent);
    if (parent == point_of.end()) link.at.fail("the number of a sample in this file", correct_it);
    graph.edges.emplace_back(parent->second, link.point);
  }
  for (const auto& [from, to] : comments.cuts) {
    const auto a = point_of.find(from);
    const auto b = point_of.find(to);
    if (a == point_of.end() || b == point_of.end()) {
      file.fail("\"# cut " + std::to_string(from) + " " + std::to_string(to) + "\"",
                "two samples in this file", correct_it);
    }
    graph.edges.emplace_back(a->second, b->second);
  }
  for (const std::int64_t id : comments.without_radius) {
    const auto point = point_of.find(id);
    if (point != point_of.end()) {
      graph.radii[static_cast<std::size_t>(point->second)] = RawGraph::unknown;
    }
  }
  return graph;
}

}  // namespace curveskel
