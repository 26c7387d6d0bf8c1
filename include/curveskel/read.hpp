// Surface files in: polygons as the file has them, nothing repaired yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class SurfaceFormat { obj, off, ply, stl, om, gltf, glb, vtp, vtk, three_mf, dae, fbx };

inline constexpr NameTable<SurfaceFormat, 12> surface_formats{{
    {SurfaceFormat::obj, "obj", "Wavefront OBJ"},
    {SurfaceFormat::off, "off", "Object File Format (OFF, COFF, NOFF, ...)"},
    {SurfaceFormat::ply, "ply", "Stanford PLY, ASCII or binary"},
    {SurfaceFormat::stl, "stl", "Stereolithography, ASCII or binary"},
    {SurfaceFormat::om, "om", "OpenMesh's OM, binary"},
    {SurfaceFormat::gltf, "gltf", "glTF 2.0, JSON with buffers beside it"},
    {SurfaceFormat::glb, "glb", "glTF 2.0, one binary file"},
    {SurfaceFormat::vtp, "vtp", "VTK's XML PolyData"},
    {SurfaceFormat::vtk, "vtk", "VTK's legacy PolyData, ASCII or binary"},
    {SurfaceFormat::three_mf, "3mf", "3D Manufacturing Format"},
    {SurfaceFormat::dae, "dae", "COLLADA"},
    {SurfaceFormat::fbx, "fbx", "Filmbox, from version 7 on, ASCII or binary"},
}};

/// Polygons as read. Polygon p has the corners corners[offsets[p]] .. corners[offsets[p + 1] - 1].
struct PolygonSoup {
  Positions positions;                ///< #V by 3, the vertices of the file in the file's order
  std::vector<std::int32_t> corners;  ///< vertex indices, all within [0, #V)
  std::vector<std::int64_t> offsets;  ///< #P + 1 entries, the first 0
  SurfaceFormat format = SurfaceFormat::obj;
  bool faces_minus_z = false;  ///< figures look along -z, as in VRM 0.x; else nothing is known
  bool z_is_up = false;        ///< the file says so (FBX, COLLADA); else nothing is known
  bool posed = false;          ///< joints bend it away from the pose in which they were bound
  std::filesystem::path file;  ///< where it comes from, for messages; may be empty
  /// Vertices of the file with NaN or infinity: they have their rows, at the place of another, and
  /// no polygons.
  std::int64_t unplaced_vertices = 0;
  std::int64_t unplaced_polygons = 0;  ///< of the file, dropped as such a vertex is a corner
  /// From its coordinates to glTF's (y up, z ahead, metres), by the axes and the unit that the file
  /// states (FBX, COLLADA): a turn and a scale. Else nothing is known.
  Eigen::Matrix3d to_gltf = Eigen::Matrix3d::Identity();
};

/// Which way is up in a file of this format, whose `to_gltf` it is, of length 1; zero where neither
/// the format nor the file says so (all but glTF, FBX and COLLADA).
[[nodiscard]] Eigen::Vector3d stated_up(SurfaceFormat format, const Eigen::Matrix3d& to_gltf);

/// The same for pictures, as other programs show the file: OBJ, which says nothing, has y up.
[[nodiscard]] Eigen::Vector3d customary_up(SurfaceFormat format, const Eigen::Matrix3d& to_gltf);

/// The triangles as polygons, of no file.
[[nodiscard]] PolygonSoup soup_of(const Surface& surface);

struct ReadOptions {
  /// glTF, FBX and COLLADA whose joints rest in another pose than they were bound in: skinned
  /// meshes as they were bound, where the topmost joint takes them, instead of as they rest; meshes
  /// that hang from a joint go with it. Of FBX and COLLADA, figures not bent stay as they rest.
  bool as_bound = false;
};

/// Reads any supported file, gzipped or not (".ply.gz"); the format follows from the content where
/// that is unambiguous and from the extension otherwise.
/// Polygons of vertices with NaN or infinity are left out, if at least half of all remain.
/// Throws Error(Fault::input) naming the file and, for text, the line. Time and memory linear in
/// the file's size; a header's counts are checked against it before anything is allocated.
[[nodiscard]] PolygonSoup read_polygons(const std::filesystem::path& path,
                                        const Monitor& monitor = {},
                                        const ReadOptions& options = {});

/// The same of a file's whole content, as it comes through a pipe: `name` is for messages and
/// `PolygonSoup::file`, and its extension counts where the content leaves the format open. Files
/// beside it (buffers of a .gltf) are sought in the folder of `name`.
[[nodiscard]] PolygonSoup read_polygons_in(std::string content, const std::filesystem::path& name,
                                           const Monitor& monitor = {},
                                           const ReadOptions& options = {});

/// Vertices that have NaN or infinity, in polygons from elsewhere, as reading takes them: polygons
/// of such vertices go, the vertices keep their rows, at the place of another, and both are counted
/// in the soup. So positions are finite on return. Throws Error(Fault::input) where more polygons
/// would go than stay. O(#V + corners).
void drop_unplaced_vertices(PolygonSoup& soup);

}  // namespace curveskel
