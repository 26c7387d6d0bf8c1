// A mesh with all that a corner of a face may name in a file: texture coordinates, normals,
// colours, materials.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rig/gltf/texture_transform.hpp"

namespace curveskel {

/// Indices from 0; -1 = none.
struct DressedCorner {
  std::int32_t place = -1;
  std::int32_t texture = -1;
  std::int32_t normal = -1;
  std::int32_t colour = -1;
};

/// Sets of texture coordinates, and of colours, that are kept of a file: as many as Blender has.
constexpr std::size_t most_sets = 8;

/// u v of each set; v counts from the picture's lower edge.
using TextureRow = std::array<float, 2 * most_sets>;

/// Linear RGBA of each set, factors on the materials' colours.
using ColourRow = std::array<float, 4 * most_sets>;

/// Moves of places, of which a slider applies a share.
struct DressedShape {
  std::string name;
  std::size_t part = 0;                           ///< the mesh that has it
  double weight = 0;                              ///< the share that is applied at first
  std::map<std::int32_t, Eigen::Vector3d> moves;  ///< by place
};

/// A mesh of a file that has several: its faces from the first one to the next mesh's, the places
/// of these, and from the first place to the next mesh's those that no face has.
struct DressedPart {
  std::string name;
  std::size_t first_place = 0;
  std::size_t first_face = 0;
  std::vector<std::string> texture_sets = {};  ///< the names of those that it has; may be empty
  std::vector<std::string> colour_sets = {};   ///< likewise; without use where there are no colours
  int joint = -1;  ///< of the file's, from which it hangs without a skin; -1 = none
};

/// Face f has the corners corners[offsets[f]] .. corners[offsets[f + 1] - 1].
struct DressedMesh {
  std::vector<double> places;  ///< x y z x y z ..., without the shapes
  std::vector<TextureRow> textures;
  std::vector<std::array<float, 3>> normals;
  std::vector<ColourRow> colours;
  std::vector<DressedCorner> corners;
  std::vector<std::int64_t> offsets{0};
  std::vector<int> material_of_face;   ///< -1 = none
  std::vector<std::string> materials;  ///< their names
  std::vector<DressedShape> shapes;
  std::vector<DressedPart> parts;  ///< in their order; empty = all is one, with a set of each
  /// From the places to glTF's: y up, z ahead, metres. A similarity.
  Eigen::Affine3d to_gltf = Eigen::Affine3d::Identity();

  void drop_colours() {
    colours.clear();
    for (DressedCorner& corner : corners) corner.colour = -1;
  }

  [[nodiscard]] bool has_polygons() const {
    return offsets.size() > 1 && corners.size() > 3 * (offsets.size() - 1);
  }

  /// Nothing that a file without looks would lose.
  [[nodiscard]] bool is_bare() const {
    return parts.size() < 2 && textures.empty() && normals.empty() && materials.empty() &&
           shapes.empty() && colours.empty() && to_gltf.matrix().isIdentity(0);
  }
};

/// A picture that a file has within it, or names.
struct DressedPicture {
  std::filesystem::path path;       ///< under which it is known, and sought if there are no bytes
  std::string name;                 ///< as the file has it
  std::string bytes;                ///< of PNG or JPEG
  std::size_t set = 0;              ///< of texture coordinates
  TextureTransform transform = {};  ///< v counts from the picture's lower edge

  [[nodiscard]] bool is_same_picture(const DressedPicture& other) const {
    return path == other.path && bytes == other.bytes;
  }
};

/// Numbers are of 0..1, those beyond are taken as the nearest, but for emission.
struct MaterialLook {
  std::optional<std::array<double, 3>> colour;
  std::optional<std::array<double, 3>> emission;  ///< beyond 1 it shines the brighter
  double opacity = 1;
  double roughness = 1;
  double metalness = 0;
  std::optional<DressedPicture> base;  ///< in place of the colour
  std::optional<DressedPicture> normals;
  double normal_strength = 1;  ///< a factor on their slopes
  std::optional<DressedPicture> light;
  bool base_has_alpha = false;  ///< one sees through where the picture says so
  bool two_sided = false;       ///< seen from behind, too
};

struct DressedMaterial {
  std::string name;
  std::optional<MaterialLook> look;  ///< nothing: the name is all that is known
};

}  // namespace curveskel
