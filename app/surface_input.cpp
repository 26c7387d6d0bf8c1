#include "app/surface_input.hpp"

#include <array>
#include <cstdio>
#include <utility>

namespace curveskel {
namespace {

std::string standard_input(const Monitor& monitor) {
  std::string content;
  std::array<char, 1U << 16U> chunk{};
  for (;;) {
    const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), stdin);
    if (got == 0) return content;
    content.append(chunk.data(), got);
    monitor.report("read", 0);
  }
}

}  // namespace

bool is_standard_input(const std::filesystem::path& mesh) { return mesh == "-"; }

std::string name_of_input(const std::filesystem::path& mesh) {
  return is_standard_input(mesh) ? "standard input" : mesh.filename().string();
}

PolygonSoup read_surface(const std::filesystem::path& mesh, const Monitor& monitor) {
  if (!is_standard_input(mesh)) return read_polygons(mesh, monitor);
  return read_polygons_in(standard_input(monitor), name_of_input(mesh), monitor);
}

}  // namespace curveskel
