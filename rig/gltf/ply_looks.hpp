// The look of a PLY file: of scans, above all.
#pragma once

#include <optional>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_file.hpp"

namespace curveskel {

/// Colours of vertices (red, green, blue, alpha), their normals (nx, ny, nz), their texture
/// coordinates (s and t, u and v, texture_u and texture_v) or those of the faces' corners
/// (texcoord), and the picture that a comment "TextureFile" names; nothing where the header has
/// none of these. Throws Error(Fault::input) as `read_polygons`.
[[nodiscard]] std::optional<DressedFile> read_ply_looks(const FileBytes& file,
                                                        const Monitor& monitor);

}  // namespace curveskel
