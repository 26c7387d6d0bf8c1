// OpenGL's picture as a PNG file.
#pragma once

#include <string>

#include "viewer/render/renderer.hpp"

namespace curveskel::viewer {

/// Averages blocks of factor x factor pixels. Precondition: both sides are multiples of it.
[[nodiscard]] PixelRows shrunk(const PixelRows& rows, int factor);

/// The bytes of an RGBA file, its colours no longer premultiplied; the first row is the top.
[[nodiscard]] std::string png_of(const PixelRows& rows);

}  // namespace curveskel::viewer
