// A repaired surface whose map, rims and sheets are of its own vertices, checked where it enters.
#pragma once

#include <string_view>

#include <curveskel/repair.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that begins with `purpose` unless corners, rims and sheets are
/// vertices of the surface, and no vertex of the file has one that there is not; negative ones
/// stand for none. One pass over the arrays.
void require_sound(const RepairedSurface& repaired, std::string_view purpose);

}  // namespace curveskel
