// Surface files, out.
#pragma once

#include <string>
#include <string_view>

#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Those of `surface_formats` that can be written.
inline constexpr NameTable<SurfaceFormat, 5> written_surface_formats{
    {surface_formats[0], surface_formats[1], surface_formats[2], surface_formats[3],
     surface_formats[4]}};

/// The bytes of an OBJ, OFF, PLY (binary, little-endian, double), STL (binary, float) or OM
/// (double) file; give them to `write_file`. Reading all but STL gives the same doubles and the
/// same order back. `provenance` becomes a comment, which OM has none of: line ends in it become
/// blanks; may be empty. Throws Error(Fault::output) for formats that are only read, for STL where
/// single precision would move a vertex by more than 1e-4 of the bounding box's diagonal, and for
/// OM where the faces are no oriented 2-manifold, with or without boundary. O(#V + #F).
[[nodiscard]] std::string format_surface(const Surface& surface, SurfaceFormat format,
                                         std::string_view provenance = {});

}  // namespace curveskel
