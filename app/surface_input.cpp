#include "app/surface_input.hpp"

#include <array>
#include <cstdio>
#include <string_view>
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

/// Of PLY a guess by its header, which is not read where it is gzipped.
bool may_have_look(SurfaceFormat format, std::string_view header) {
  switch (format) {
    case SurfaceFormat::obj:
    case SurfaceFormat::gltf:
    case SurfaceFormat::glb:
    case SurfaceFormat::dae:
    case SurfaceFormat::fbx:
      return true;
    case SurfaceFormat::ply:
      return !header.starts_with("ply") || header.find(" red") != std::string_view::npos ||
             header.find("texture") != std::string_view::npos;
    default:
      return false;
  }
}

}  // namespace

bool is_standard_input(const std::filesystem::path& mesh) { return mesh == "-"; }

std::string name_of_input(const std::filesystem::path& mesh) {
  return is_standard_input(mesh) ? "standard input" : mesh.filename().string();
}

PolygonSoup read_surface(const std::filesystem::path& mesh, const Monitor& monitor) {
  if (!is_standard_input(mesh)) return read_polygons(mesh, monitor);
  bool loses_look = false;
  return read_standard_input(monitor, loses_look);
}

PolygonSoup read_standard_input(const Monitor& monitor, bool& loses_look) {
  constexpr std::size_t header_size = 4000;
  std::string content = standard_input(monitor);
  const std::string header = content.substr(0, header_size);
  PolygonSoup soup = read_polygons_in(std::move(content), name_of_input("-"), monitor);
  loses_look = may_have_look(soup.format, header);
  return soup;
}

}  // namespace curveskel
