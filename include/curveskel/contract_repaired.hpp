// Contraction of a repaired surface, each component for itself.
#pragma once

#include <vector>

#include <curveskel/contract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RepairedContraction {
  Positions positions;                  ///< #V of the repaired surface: where each vertex ends up
  std::vector<Contraction> components;  ///< in the order of `topology`
};

/// `contract` of each component, with the inscribed balls that the medial flow needs; frames say of
/// which component they are. Errors as `contract`.
[[nodiscard]] RepairedContraction contract_repaired(const RepairedSurface& repaired,
                                                    const ContractionOptions& options = {},
                                                    const Monitor& monitor = {});

/// The file's own vertices, in triangles, at `positions` of a repaired surface; those that repair
/// left out stay where they are. O(#V + #F).
[[nodiscard]] Surface moved_vertices(const PolygonSoup& soup, const RepairedSurface& repaired,
                                     const Positions& positions);

}  // namespace curveskel
