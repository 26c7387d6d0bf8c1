// Fewer vertices, same topology, every input vertex accounted for.
#pragma once

#include <Eigen/Core>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct CoarsenOptions {
  int target_vertices = 8000;  ///< working resolution; a smaller surface is left as it is
  int threads = 0;             ///< at most, 0 = one per core; the result does not depend on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const CoarsenOptions& options);

struct Coarsened {
  Surface surface;
  Eigen::VectorXi vertex_of_input;  ///< #V of the input: the vertex that it was merged into
  Surface halfway;  ///< finer than `surface`: left by the parts; empty without parts
};

/// True if a surface with so many vertices is collapsed in parts first.
[[nodiscard]] bool coarsens_in_parts(Eigen::Index vertices, const CoarsenOptions& options);

/// Edge collapse by quadric error (Garland and Heckbert 1997) in passes without a heap, under the
/// link condition, so the genus of every component is kept. Far too fine surfaces are collapsed in
/// parts first, in parallel. Deterministic, for any number of threads.
/// Precondition: closed oriented 2-manifold. May stop above the target where no edge may go.
[[nodiscard]] Coarsened coarsen(const Surface& surface, const CoarsenOptions& options = {},
                                const Monitor& monitor = {});

}  // namespace curveskel
