// The steps of `clean` that need to walk over a closed surface.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>
#include "surface/mesh/half_edges.hpp"

namespace curveskel {

/// Gives every umbrella (fan of faces around a vertex) a vertex of its own: where a vertex has
/// several, copies of it are appended to the positions. Returns how many.
/// Precondition: every half-edge has a twin. Twins stay valid. O(#F).
std::int64_t split_umbrellas(Surface& surface, const HalfEdges& half_edges);

struct Orientation {
  std::vector<std::int32_t> component_of_face;
  std::int32_t components = 0;
  std::vector<bool> turn;  ///< #F, what to turn so that neighbours agree: the fewer per component
  std::int32_t conflict = -1;  ///< first half-edge across which they cannot agree, -1 = none
};

/// Precondition: every half-edge has a twin. O(#F).
[[nodiscard]] Orientation orient(const Triangles& triangles, const HalfEdges& half_edges);

/// Of one component, with its extent (longest side of its bounding box) as the unit of length, so
/// that neither the model's unit nor its origin matters; all 0 if it is a single point.
struct ComponentSums {
  std::int32_t first_face = -1;
  double area = 0;
  double volume = 0;  ///< signed, positive when outward

  /// False where the sides are no farther apart, for the area's side, than two neighbouring numbers
  /// of single precision, in which most files are. A vertex far away makes no sheet of a body.
  [[nodiscard]] bool encloses_something() const;
};

/// The same for any number of threads. O(#V + #F).
[[nodiscard]] std::vector<ComponentSums> component_sums(const Surface& surface,
                                                        const Orientation& orientation,
                                                        int threads);

}  // namespace curveskel
