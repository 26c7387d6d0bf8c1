#include <curveskel/read.hpp>

#include <optional>
#include <string>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include "surface/read/file_bytes.hpp"
#include "surface/read/foreign_formats.hpp"
#include "surface/read/formats.hpp"
#include "surface/read/placed_vertices.hpp"

namespace curveskel {
namespace {

/// Of "cow.ply.gz" it is ply.
std::optional<SurfaceFormat> format_by_extension(const std::filesystem::path& path) {
  return choice_of(surface_formats, std::string_view(lower_extension(without_gz(path))));
}

std::optional<SurfaceFormat> format_by_content(const FileBytes& file) {
  if (looks_like_glb(file)) return SurfaceFormat::glb;
  if (looks_like_3mf(file)) return SurfaceFormat::three_mf;
  if (looks_like_fbx(file)) return SurfaceFormat::fbx;
  if (looks_like_om(file)) return SurfaceFormat::om;
  if (looks_like_ply(file)) return SurfaceFormat::ply;
  if (looks_like_off(file)) return SurfaceFormat::off;
  if (looks_like_vtp(file)) return SurfaceFormat::vtp;
  if (looks_like_dae(file)) return SurfaceFormat::dae;
  if (looks_like_vtk(file)) return SurfaceFormat::vtk;
  if (looks_like_gltf(file)) return SurfaceFormat::gltf;
  if (looks_like_stl(file)) return SurfaceFormat::stl;
  if (looks_like_obj(file)) return SurfaceFormat::obj;
  return std::nullopt;
}

PolygonSoup read_as(SurfaceFormat format, const FileBytes& file, const Monitor& monitor,
                    const ReadOptions& options) {
  switch (format) {
    case SurfaceFormat::obj:
      return read_obj(file, monitor);
    case SurfaceFormat::off:
      return read_off(file, monitor);
    case SurfaceFormat::ply:
      return read_ply(file, monitor);
    case SurfaceFormat::stl:
      return read_stl(file, monitor);
    case SurfaceFormat::om:
      return read_om(file, monitor);
    case SurfaceFormat::gltf:
    case SurfaceFormat::glb:
      return read_gltf(file, monitor, options);
    case SurfaceFormat::vtp:
      return read_vtp_surface(file, monitor);
    case SurfaceFormat::vtk:
      return read_vtk(file, monitor);
    case SurfaceFormat::three_mf:
      return read_3mf(file, monitor);
    case SurfaceFormat::dae:
      return read_dae(file, monitor, options);
    case SurfaceFormat::fbx:
      return read_fbx(file, monitor, options);
  }
  file.fail("no known format", names_in(surface_formats), "convert it");
}

}  // namespace

Eigen::Vector3d stated_up(SurfaceFormat format, const Eigen::Matrix3d& to_gltf) {
  const bool is_stated = format == SurfaceFormat::gltf || format == SurfaceFormat::glb ||
                         format == SurfaceFormat::dae || format == SurfaceFormat::fbx;
  if (!is_stated) return Eigen::Vector3d::Zero();
  return to_gltf.row(1).transpose().stableNormalized();
}

Eigen::Vector3d customary_up(SurfaceFormat format, const Eigen::Matrix3d& to_gltf) {
  if (format == SurfaceFormat::obj) return Eigen::Vector3d::UnitY();
  return stated_up(format, to_gltf);
}

std::optional<SurfaceFormat> surface_format_of(const FileBytes& file) {
  const std::optional<SurfaceFormat> format = format_by_content(file);
  return format ? format : format_by_extension(file.path);
}

PolygonSoup soup_of(const Surface& surface) {
  PolygonSoup soup;
  soup.positions = surface.positions;
  soup.corners.assign(surface.triangles.data(),
                      surface.triangles.data() + surface.triangles.size());
  soup.offsets.resize(static_cast<std::size_t>(surface.triangles.rows()) + 1);
  for (std::size_t f = 0; f < soup.offsets.size(); ++f) {
    soup.offsets[f] = static_cast<std::int64_t>(3 * f);
  }
  return soup;
}

PolygonSoup read_content(const FileBytes& file, const Monitor& monitor,
                         const ReadOptions& options) {
  refuse_own_json(file);
  if (!format_by_content(file)) refuse_foreign_format(file);
  const std::optional<SurfaceFormat> format = surface_format_of(file);
  if (!format) {
    refuse_skeleton(file);
    file.fail("content that begins with " + in_quotes(file.content.substr(0, 41)) +
                  " and no known extension",
              "a surface as one of " + names_in(surface_formats),
              "convert it, or name it by the extension of its format");
  }
  PolygonSoup soup = read_as(*format, file, monitor, options);
  soup.file = file.path;
  drop_unplaced_vertices(soup, file);
  if (soup.offsets.size() < 2) {
    const auto vertices = soup.positions.rows();
    file.fail((vertices > 0 ? "a point cloud: " : "") + std::to_string(vertices) +
                  (vertices == 1 ? " vertex" : " vertices") + " and no faces (read as " +
                  std::string(name_of(surface_formats, *format)) + ")",
              "a surface with faces",
              vertices > 0 ? "reconstruct a surface from the points first"
                           : "check the file's content and format");
  }
  monitor.report("read", 1);
  return soup;
}

PolygonSoup read_polygons(const std::filesystem::path& path, const Monitor& monitor,
                          const ReadOptions& options) {
  monitor.report("read", 0);
  return read_content(read_file(path, monitor), monitor, options);
}

PolygonSoup read_polygons_in(std::string content, const std::filesystem::path& name,
                             const Monitor& monitor, const ReadOptions& options) {
  monitor.report("read", 0);
  return read_content(unpacked({name, std::move(content)}, monitor), monitor, options);
}

}  // namespace curveskel
