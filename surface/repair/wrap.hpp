// A closed surface around anything, for one that cannot be closed along its own edges.
#pragma once

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct WrapOptions {
  double gap = 0;     ///< alpha in model units: what is narrower is not entered, what is up to
                      ///< twice as wide may not be; > 0
  double offset = 0;  ///< distance of the wrap from the triangles in model units; > 0
};

/// The narrowest, in model units, that makes a wrap of a million vertices at most, some minutes'
/// work, and one that fits into memory; infinity where none does.
[[nodiscard]] double narrowest_gap(const Surface& triangles);

/// Shrinks a closed 2-manifold onto the triangles from outside (alpha wrapping, Portaneri et al.
/// 2022). Contains all of them; everything that a gap wider than 2 alpha leads to is outside.
/// Any triangles will do: crossing, doubled, with holes. Time and faces grow with area / alpha^2.
/// Throws Error(Fault::input) for a narrower gap than `narrowest_gap`, Cancelled on a stop.
[[nodiscard]] Surface wrap(const Surface& triangles, const WrapOptions& options,
                           const Monitor& monitor);

}  // namespace curveskel
