// The look of a surface's file: its pictures, and where they lie on the triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// As in the file: PNG, JPEG, or what extensions of glTF have.
struct EncodedPicture {
  std::string bytes;
};

/// The share of white light that a triangle reflects.
struct SurfaceMaterial {
  std::array<float, 4> colour{1, 1, 1, 1};  ///< linear RGBA, a factor on the picture's
  int picture = -1;                         ///< -1 = none
  bool is_cut_out = false;                  ///< nothing is seen where alpha is under .5
  std::array<bool, 2> repeats{true, true};  ///< the picture beyond 0..1, across and along it
};

/// A surface as it is drawn: its vertices stand more than once where triangles that meet there have
/// other texture coordinates.
struct SurfaceMaterials {
  std::vector<SurfaceMaterial> materials;
  std::vector<EncodedPicture> pictures;
  std::vector<int> vertices;           ///< n, of each vertex drawn that of the file
  Eigen::MatrixX2f places_in_picture;  ///< n x 2, (0, 0) = the upper left corner
  Eigen::MatrixX4f colours;            ///< n x 4, linear RGBA, factors on the material's
  Triangles triangles;                 ///< those of the file; of OBJ by material
  std::vector<int> material;           ///< of each triangle; -1 = none
};

/// Of glTF the base colours, of OBJ, COLLADA and FBX the diffuse ones, of PLY colours and picture;
/// nothing for other formats and where a file has neither materials nor colours. Pictures that are
/// missing are left out. Throws Error(Fault::input) as `read_polygons`. O(bytes of the file).
[[nodiscard]] std::optional<SurfaceMaterials> read_materials(const std::filesystem::path& path,
                                                             const Monitor& monitor = {});

}  // namespace curveskel
