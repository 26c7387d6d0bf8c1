// A software renderer for one thing: a closed surface that looks half transparent.
#pragma once

#include <curveskel/surface.hpp>
#include <curveskel/view.hpp>
#include "skeleton/picture/image.hpp"

namespace curveskel {

/// Draws the surface into a part of the image that is white. Per pixel it shows the front-most
/// normal (light from the upper left, and an outline where the surface turns away), hollows and
/// overlaps darkened (Luft et al. 2006, unsharp masking of the depth buffer), and the thickness
/// that the ray passes through (the thicker, the deeper the colour). The same pixels for any number
/// of threads. `normals` are #V by 3 unit vectors. O(#F + pixels).
void shade_surface(const Surface& surface, const Positions& normals, const View& view, int threads,
                   Image& image);

}  // namespace curveskel
