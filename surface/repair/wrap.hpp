// A closed surface around anything, for one that cannot be closed along its own edges.
#pragma once

#include <cstdint>
#include <string>

#include <curveskel/error.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct WrapOptions {
  double gap = 0;     ///< alpha in model units: what is narrower is not entered, what is up to
                      ///< twice as wide may not be; > 0
  double offset = 0;  ///< distance of the wrap from the triangles in model units; > 0
};

/// The vertices that wraps may have before they are given up: the measure of their time (half a
/// millisecond each) and memory that is the same on every machine.
struct WrapBudget {
  std::int64_t vertices = 4000000;  ///< left; half an hour's work
  double for_expected = 1.5;        ///< made for each area of gap^2: 1 to 4, more where faces cross
};

/// A wrap beyond its budget, or beyond memory.
class WrapTooLarge : public Error {
 public:
  explicit WrapTooLarge(const std::string& message) : Error(Fault::input, message) {}
};

/// The narrowest, in model units, that makes a wrap of a million vertices at most, some minutes'
/// work, and one that fits into memory; infinity where none does.
[[nodiscard]] double narrowest_gap(const Surface& triangles);

/// Shrinks a closed 2-manifold onto the triangles from outside (alpha wrapping, Portaneri et al.
/// 2022). Contains all of them; everything that a gap wider than 2 alpha leads to is outside.
/// Any triangles will do: crossing, doubled, with holes. Time and faces grow with area / alpha^2;
/// both sides of a sheet count, and more where the offset is much less than alpha.
/// Takes the vertices that it makes from the budget. Throws WrapTooLarge for a narrower gap than
/// `narrowest_gap`, and as soon as the budget is spent; at once if area / alpha^2
/// times `for_expected` tells that it will be. Cancelled on a stop.
[[nodiscard]] Surface wrap(const Surface& triangles, const WrapOptions& options, WrapBudget& budget,
                           const Monitor& monitor);

}  // namespace curveskel
