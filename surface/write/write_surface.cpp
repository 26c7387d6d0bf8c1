#include <curveskel/write_surface.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/error.hpp>
#include "base/decimal.hpp"
#include "base/one_line.hpp"
#include "surface/mesh/single_precision.hpp"
#include "surface/write/write_om.hpp"

namespace curveskel {
namespace {

static_assert(std::endian::native == std::endian::little);

void append_comment(std::string& text, std::string_view keyword, std::string_view provenance) {
  if (!provenance.empty())
    text.append(keyword).append(" ").append(in_one_line(provenance)).append("\n");
}

template <typename Value>
void append_bytes(std::string& bytes, const Value& value) {
  const std::size_t used = bytes.size();
  bytes.resize(used + sizeof(Value));
  std::memcpy(bytes.data() + used, &value, sizeof(Value));
}

std::string format_obj(const Surface& surface, std::string_view provenance) {
  std::string text;
  append_comment(text, "#", provenance);
  for (const auto& position : surface.positions.rowwise()) {
    text += "v ";
    append_decimals(text, position, ' ');
    text += '\n';
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    text += "f ";
    append_decimals(text, triangle.array() + 1, ' ');
    text += '\n';
  }
  return text;
}

std::string format_off(const Surface& surface, std::string_view provenance) {
  std::string text = "OFF\n";
  append_comment(text, "#", provenance);
  append_decimal(text, surface.positions.rows());
  text += ' ';
  append_decimal(text, surface.triangles.rows());
  text += " 0\n";
  for (const auto& position : surface.positions.rowwise()) {
    append_decimals(text, position, ' ');
    text += '\n';
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    text += "3 ";
    append_decimals(text, triangle, ' ');
    text += '\n';
  }
  return text;
}

std::string format_ply(const Surface& surface, std::string_view provenance) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  append_comment(bytes, "comment", provenance);
  bytes += "element vertex ";
  append_decimal(bytes, surface.positions.rows());
  bytes += "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
  append_decimal(bytes, surface.triangles.rows());
  bytes += "\nproperty list uchar int vertex_indices\nend_header\n";

  constexpr std::size_t corners_bytes = 3 * sizeof(std::int32_t);
  const auto positions_bytes = static_cast<std::size_t>(surface.positions.size()) * sizeof(double);
  const auto faces = static_cast<std::size_t>(surface.triangles.rows());
  std::size_t at = bytes.size();
  bytes.resize(at + positions_bytes + faces * (1 + corners_bytes));
  std::copy_n(reinterpret_cast<const char*>(surface.positions.data()), positions_bytes,
              bytes.begin() + static_cast<std::ptrdiff_t>(at));
  at += positions_bytes;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    bytes[at] = 3;
    std::memcpy(bytes.data() + at + 1, surface.triangles.data() + 3 * f, corners_bytes);
    at += 1 + corners_bytes;
  }
  return bytes;
}

std::string format_stl(const Surface& surface, std::string_view provenance) {
  constexpr std::size_t header_bytes = 80;
  constexpr std::size_t bytes_per_face = 50;
  require_single_precision(surface.positions, "STL", "write obj, off or ply instead, or ");
  // A header that begins with "solid" would announce the text variant.
  std::string bytes = "binary STL " + in_one_line(provenance);
  bytes.resize(header_bytes, ' ');
  bytes.reserve(header_bytes + 4 +
                bytes_per_face * static_cast<std::size_t>(surface.triangles.rows()));
  append_bytes(bytes, static_cast<std::uint32_t>(surface.triangles.rows()));
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Eigen::RowVector3d a = surface.positions.row(triangle(0));
    const Eigen::RowVector3d b = surface.positions.row(triangle(1));
    const Eigen::RowVector3d c = surface.positions.row(triangle(2));
    const Eigen::RowVector3d normal = (b - a).cross(c - a).stableNormalized();
    for (const auto& row : {normal, a, b, c}) {
      for (const double value : row) append_bytes(bytes, static_cast<float>(value));
    }
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace

std::string format_surface(const Surface& surface, SurfaceFormat format,
                           std::string_view provenance) {
  require_corners(surface, "format_surface");
  switch (format) {
    case SurfaceFormat::obj:
      return format_obj(surface, provenance);
    case SurfaceFormat::off:
      return format_off(surface, provenance);
    case SurfaceFormat::ply:
      return format_ply(surface, provenance);
    case SurfaceFormat::stl:
      return format_stl(surface, provenance);
    case SurfaceFormat::om:
      return format_om(surface);
    case SurfaceFormat::gltf:
    case SurfaceFormat::glb:
    case SurfaceFormat::vtp:
    case SurfaceFormat::vtk:
    case SurfaceFormat::three_mf:
    case SurfaceFormat::dae:
    case SurfaceFormat::fbx:
      break;
  }
  throw Error(Fault::output,
              "found the surface format " + std::string(name_of(surface_formats, format)) +
                  ", which is only read, needed one of: " + names_in(written_surface_formats));
}

}  // namespace curveskel
