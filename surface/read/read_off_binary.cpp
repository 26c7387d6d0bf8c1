// Geomview's "OFF BINARY": big-endian 32-bit integers and floats. OpenMesh writes the same in the
// machine's order and leaves out the number of colours behind each face; both are told apart by
// the counts, of which only one order fits into the file.
#include <array>
#include <string>

#include "surface/read/binary_cursor.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

constexpr std::size_t word_bytes = 4;
constexpr std::string_view broken_remedy =
    "the file is truncated or broken: fetch or export it again";

std::size_t words_per_vertex(const OffKeyword& keyword) {
  return 3 + (keyword.normals ? 3U : 0U) + (keyword.colours ? 4U : 0U) +
         (keyword.texture ? 2U : 0U);
}

struct BinaryOffCounts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

BinaryOffCounts take_counts(BinaryCursor& bytes) {
  BinaryOffCounts counts;
  counts.vertices = bytes.take<std::int32_t>();
  counts.faces = bytes.take<std::int32_t>();
  bytes.skip(word_bytes);  // edges
  return counts;
}

/// A face has at least its number of corners.
bool fits(const BinaryOffCounts& counts, std::size_t words, std::size_t bytes_left) {
  const auto vertex_bytes = static_cast<std::int64_t>(word_bytes * words);
  const auto left = static_cast<std::int64_t>(bytes_left);
  return counts.vertices >= 0 && counts.faces >= 0 && counts.vertices <= left / vertex_bytes &&
         counts.faces <= (left - counts.vertices * vertex_bytes) / 4;
}

void take_positions(BinaryCursor& bytes, std::size_t words, PolygonSoup& soup,
                    const Monitor& monitor) {
  for (Eigen::Index i = 0; i < soup.positions.rows(); ++i) {
    if (i % rows_per_report == 0) monitor.report("read", bytes.fraction());
    for (int k = 0; k < 3; ++k) {
      soup.positions(i, k) = static_cast<double>(bytes.take<float>());
    }
    bytes.skip((words - 3) * word_bytes);
  }
}

void take_face(const FileBytes& file, BinaryCursor& bytes, bool colour_count, PolygonSoup& soup) {
  const std::string which =
      " in face " + std::to_string(soup.offsets.size() - 1) + " (counted from 0)";
  const auto corners = bytes.take<std::uint32_t>();
  bytes.require(word_bytes * corners);
  for (std::uint32_t k = 0; k < corners; ++k) {
    const auto vertex = bytes.take<std::int32_t>();
    if (vertex < 0 || vertex >= soup.positions.rows()) {
      file.fail("vertex " + std::to_string(vertex) + which,
                "one from 0 to " + std::to_string(soup.positions.rows() - 1), broken_remedy);
    }
    soup.corners.push_back(vertex);
  }
  end_polygon(soup);
  if (colour_count) bytes.skip(word_bytes * std::size_t{bytes.take<std::uint32_t>()});
}

}  // namespace

PolygonSoup read_binary_off(const FileBytes& file, std::size_t begin, const OffKeyword& keyword,
                            const Monitor& monitor) {
  const std::size_t words = words_per_vertex(keyword);
  std::endian order = std::endian::big;
  BinaryCursor bytes(file, begin, order);
  BinaryOffCounts counts = take_counts(bytes);
  if (!fits(counts, words, bytes.bytes_left())) {
    order = std::endian::little;
    BinaryCursor other(file, begin, order);
    const BinaryOffCounts swapped = take_counts(other);
    if (!fits(swapped, keyword.colours ? 3 : words, other.bytes_left())) {
      file.fail(
          std::to_string(counts.vertices) + " vertices and " + std::to_string(counts.faces) +
              " faces announced in binary OFF",
          "counts that fit into the " + std::to_string(bytes.bytes_left()) + " bytes that follow",
          broken_remedy);
    }
    if (keyword.colours) {
      file.fail("coloured binary OFF as OpenMesh writes it, which does not tell its layout",
                "binary OFF without colours", "write it as OM, PLY or text");
    }
    bytes = other;
    counts = swapped;
  }
  PolygonSoup soup;
  soup.format = SurfaceFormat::off;
  soup.positions.resize(counts.vertices, 3);
  take_positions(bytes, words, soup, monitor);
  soup.offsets.reserve(static_cast<std::size_t>(counts.faces) + 1);
  soup.offsets.push_back(0);
  for (std::int64_t f = 0; f < counts.faces; ++f) {
    if (f % rows_per_report == 0) monitor.report("read", bytes.fraction());
    take_face(file, bytes, order == std::endian::big, soup);
  }
  return soup;
}

}  // namespace curveskel
