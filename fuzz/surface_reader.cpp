// Any bytes as a surface file: either an error about the input or polygons that hold together.
// CURVESKEL_READER is the reader, see CMakeLists.txt.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <curveskel/error.hpp>
#include "surface/read/formats.hpp"
#include "surface/read/gunzip.hpp"
#include "surface/read/placed_vertices.hpp"
#include "surface/read/utf16.hpp"

namespace {

using namespace curveskel;

/// By content, unzipped where it is zipped and UTF-8 where it was UTF-16, as files are read.
[[maybe_unused]] PolygonSoup read_gzipped(FileBytes& file, const Monitor& monitor) {
  if (is_gzipped(file.content)) gunzip(file, monitor);
  if (is_utf16(file.content)) utf16_to_utf8(file);
  if (file.content.empty()) throw Error(Fault::input, "empty");
  return read_content(file, monitor);
}

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const PolygonSoup& soup) {
  require(soup.positions.allFinite());
  require(!soup.offsets.empty() && soup.offsets.front() == 0);
  require(soup.offsets.back() == static_cast<std::int64_t>(soup.corners.size()));
  for (std::size_t p = 1; p < soup.offsets.size(); ++p) {
    require(soup.offsets[p - 1] <= soup.offsets[p]);
  }
  for (const std::int32_t corner : soup.corners) {
    require(corner >= 0 && corner < soup.positions.rows());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FileBytes file{"/nonexistent/fuzzed", std::string(reinterpret_cast<const char*>(data), size)};
  try {
    PolygonSoup soup = CURVESKEL_READER(file, {});
    drop_unplaced_vertices(soup, file);
    check(soup);
  } catch (const Error& error) {
    require(error.fault() == Fault::input);
  }
  return 0;
}
