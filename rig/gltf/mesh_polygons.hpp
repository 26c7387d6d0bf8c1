// Polygons of a mesh that glTF has as triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace curveskel {

/// Of a mesh whose primitives share their vertices: the first are those of the file, one a place,
/// the others copies of them at seams. Polygon k has the vertices corners[offsets[k]] ..
/// corners[offsets[k + 1] - 1], three or more; polygons are in the file's order.
struct MeshPolygons {
  std::size_t places = 0;                     ///< how many vertices are the file's
  std::vector<std::int32_t> place_of_vertex;  ///< of these; of the first ones their own number
  std::vector<std::int32_t> corners;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::size_t> primitive_of_face;
};

}  // namespace curveskel
