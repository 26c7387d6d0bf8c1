// The polygons of a COLLADA geometry. Internal to surface/.
#pragma once

#include <curveskel/read.hpp>
#include "surface/read/dae_document.hpp"

namespace curveskel {

/// The polygons of <geometry>, in its own coordinates: none where it has no <mesh>. Lines are
/// passed over. Throws Error(Fault::input) with the line.
[[nodiscard]] PolygonSoup read_dae_mesh(const DaeDocument& document, const XmlElement& geometry);

}  // namespace curveskel
