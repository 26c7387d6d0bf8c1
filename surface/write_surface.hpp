// Surface files, out.
#pragma once

#include <string>
#include <string_view>

#include "surface/read.hpp"
#include "surface/surface.hpp"

namespace curveskel {

/// The bytes of an OBJ, OFF, PLY (binary, little-endian, double) or STL (binary, float) file; give
/// them to `write_file`. Reading all but STL gives the same doubles and the same order back.
/// `provenance` becomes a comment: one line, no newline, may be empty.
/// Throws Error(Fault::output) for formats that are only read. O(#V + #F).
[[nodiscard]] std::string format_surface(const Surface& surface, SurfaceFormat format,
                                         std::string_view provenance = {});

}  // namespace curveskel
