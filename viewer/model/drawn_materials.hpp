// The materials of a file in the form in which they are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/read_materials.hpp>
#include "viewer/render/colours.hpp"

namespace curveskel::viewer {

/// Rows of RGBA from the upper edge; empty where its kind is not known here.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

/// PNG, JPEG and what else stb_image knows; halved until no side is longer than 2,048 pixels.
[[nodiscard]] Picture decoded(const EncodedPicture& encoded);

struct DrawnMaterials {
  /// Triangles that share a material, one after the other.
  struct Run {
    int picture = -1;  ///< -1 = none
    bool is_cut_out = false;
    std::array<bool, 2> repeats{true, true};
    std::size_t first = 0;  ///< triangle
    std::size_t count = 0;
  };
  std::vector<std::uint32_t> vertices;  ///< of each vertex drawn that of the file
  std::vector<glm::vec2> places;        ///< in the picture, of each vertex drawn
  std::vector<Rgba> colours;            ///< the same: factors on the picture's
  std::vector<glm::uvec3> triangles;    ///< of vertices drawn, run by run
  std::vector<Run> runs;
  std::vector<Picture> pictures;
  /// Of each vertex of the file the colour there, for simpler forms of the surface.
  std::vector<Rgba> colour_of_vertex;
};

/// Of a surface with so many vertices.
[[nodiscard]] DrawnMaterials drawn_materials(const SurfaceMaterials& given, std::size_t vertices);

/// Null where the file has none that can be drawn; broken ones count as none, as the surface can
/// be shown without.
[[nodiscard]] std::shared_ptr<const DrawnMaterials> materials_of(const std::filesystem::path& file,
                                                                 std::size_t vertices,
                                                                 const Monitor& monitor);

}  // namespace curveskel::viewer
