// One reader per file format; `read_polygons` chooses among them.
#pragma once

#include <optional>

#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include "surface/read/file_bytes.hpp"
#include "surface/read/off_keyword.hpp"

namespace curveskel {

/// All throw Error(Fault::input) with the file, the line or element, what was found and what is
/// needed. Corners lie within [0, #V) on return; positions may be NaN or infinity.
[[nodiscard]] PolygonSoup read_obj(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_off(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_ply(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_stl(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_om(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_gltf(const FileBytes& file, const Monitor& monitor,  ///< and GLB
                                    const ReadOptions& options = {});
[[nodiscard]] PolygonSoup read_vtp_surface(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_vtk(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_3mf(const FileBytes& file, const Monitor& monitor);
[[nodiscard]] PolygonSoup read_dae(const FileBytes& file, const Monitor& monitor,
                                   const ReadOptions& options = {});
[[nodiscard]] PolygonSoup read_fbx(const FileBytes& file, const Monitor& monitor,
                                   const ReadOptions& options = {});

/// The part of `read_off` for numbers in binary, which begin at byte `begin`; three dimensions.
[[nodiscard]] PolygonSoup read_binary_off(const FileBytes& file, std::size_t begin,
                                          const OffKeyword& keyword, const Monitor& monitor);

/// By the content where that is unambiguous, else by the extension.
[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(const FileBytes& file);

/// The work of `read_polygons` once the file is in memory: positions are finite on return.
[[nodiscard]] PolygonSoup read_content(const FileBytes& file, const Monitor& monitor,
                                       const ReadOptions& options = {});

/// True if the content can only be this format.
[[nodiscard]] bool looks_like_obj(const FileBytes& file);
[[nodiscard]] bool looks_like_off(const FileBytes& file);
[[nodiscard]] bool looks_like_ply(const FileBytes& file);
[[nodiscard]] bool looks_like_stl(const FileBytes& file);
[[nodiscard]] bool looks_like_om(const FileBytes& file);
[[nodiscard]] bool looks_like_gltf(const FileBytes& file);
[[nodiscard]] bool looks_like_glb(const FileBytes& file);
[[nodiscard]] bool looks_like_vtp(const FileBytes& file);
[[nodiscard]] bool looks_like_vtk(const FileBytes& file);
[[nodiscard]] bool looks_like_3mf(const FileBytes& file);  ///< or another ZIP archive
[[nodiscard]] bool looks_like_dae(const FileBytes& file);
[[nodiscard]] bool looks_like_fbx(const FileBytes& file);

/// Appends a polygon's end; for readers that append corners one by one.
inline void end_polygon(PolygonSoup& soup) {
  soup.offsets.push_back(static_cast<std::int64_t>(soup.corners.size()));
}

/// Positions from x y z x y z ...
[[nodiscard]] inline Positions positions_from(const std::vector<double>& coordinates) {
  return Eigen::Map<const Positions>(coordinates.data(),
                                     static_cast<Eigen::Index>(coordinates.size() / 3), 3);
}

/// The readers report progress once per this many rows.
inline constexpr std::int64_t rows_per_report = 1 << 16;

/// Vertex indices are 32 bits wide.
inline constexpr std::int64_t most_vertices = 2147483647;

}  // namespace curveskel
