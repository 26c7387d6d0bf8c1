// Coarser stand-ins for a surface, for machines that cannot draw it fast enough while it moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "viewer/render/shapes_shown.hpp"

namespace curveskel::viewer {

struct SimplerSurface {
  ShownSurface surface;                        ///< without colours
  std::vector<std::uint32_t> vertex_of_given;  ///< #V: one of the vertices that each stands for
};

/// Vertices within a cell of a grid become one (Rossignac and Borrel 1993); about `vertices` are
/// left. Made to be looked at only: the topology may change. O(#V log #V + #F). Throws Cancelled
/// where a stop is requested.
[[nodiscard]] SimplerSurface simpler_surface(const ShownSurface& given, std::size_t vertices,
                                             const std::stop_token& stop = {});

/// The triangles of such a form with corners that are vertices of the given surface, so that it
/// moves as that does.
[[nodiscard]] std::vector<glm::uvec3> fewer_triangles(const ShownSurface& given,
                                                      std::size_t vertices);

}  // namespace curveskel::viewer
