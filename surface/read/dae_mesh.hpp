// The polygons of a COLLADA geometry. Internal to surface/ and rig/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/read.hpp>
#include "surface/read/dae_document.hpp"

namespace curveskel {

/// One <triangles>, <polylist> and so on. A corner has as many indices as the inputs want, a tuple.
struct DaePrimitive {
  const XmlElement* element = nullptr;
  std::size_t first_corner = 0;  ///< of the mesh's
  std::size_t stride = 1;        ///< indices of a tuple
  std::vector<std::int32_t> indices;
};

struct DaeMesh {
  PolygonSoup polygons;                  ///< in the geometry's own coordinates
  std::vector<std::int32_t> tuples;      ///< of each corner, within its primitive
  std::vector<DaePrimitive> primitives;  ///< whose corners follow one another
  const XmlElement* vertices = nullptr;  ///< <vertices>, where there is a mesh
};

/// The polygons of <geometry>: none where it has no <mesh>. Lines are passed over. Throws
/// Error(Fault::input) with the line.
[[nodiscard]] DaeMesh read_dae_mesh(const DaeDocument& document, const XmlElement& geometry);

}  // namespace curveskel
