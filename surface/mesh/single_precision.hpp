// Refuses coordinates that a file with single precision alone cannot hold.
#pragma once

#include <limits>
#include <sstream>
#include <string>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Throws Error(Fault::output) where a coordinate is beyond single precision. `format` is the one
/// that has no other; `otherwise` is what else would do, up to an "or "; may be empty.
inline void require_single_range(const Positions& positions, const std::string& format,
                                 const std::string& otherwise = {}) {
  if (positions.cast<float>().allFinite()) return;
  throw Error(Fault::output, "a coordinate beyond single precision, which is all that " + format +
                                 " has; " + otherwise + "scale the surface down");
}

/// The same where rounding would move a vertex by so much that small faces are lost: far from the
/// origin the digits left over for the shape are few.
inline void require_single_precision(const Positions& positions, const std::string& format,
                                     const std::string& otherwise = {}) {
  constexpr double most = 1e-4;  // of the diagonal
  if (positions.rows() == 0) return;
  require_single_range(positions, format, otherwise);
  const double lost = (positions - positions.cast<float>().cast<double>()).cwiseAbs().maxCoeff();
  if (lost <= most * bounding_box_diagonal(positions)) return;
  constexpr auto all_digits_from = static_cast<double>(std::numeric_limits<float>::min());
  if (most * positions.cwiseAbs().maxCoeff() < all_digits_from) {
    throw Error(Fault::output, "coordinates too small for single precision, which is all that " +
                                   format + " has; " + otherwise + "scale the surface up");
  }
  std::ostringstream moved;
  moved << lost;
  throw Error(Fault::output,
              "coordinates so far from the origin that single precision, which is all that " +
                  format + " has, moves vertices by " + moved.str() + "; " + otherwise +
                  "move the surface to the origin");
}

}  // namespace curveskel
