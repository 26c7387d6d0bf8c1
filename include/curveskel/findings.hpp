// The places where a certificate fails, so that they can be shown.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {

/// An edge, or a node without one, that leaves the surface.
struct Exit {
  int edge = -1;      ///< row of the edges
  int node = -1;      ///< for a node without an edge, else -1
  double length = 0;  ///< of the curve that its outside samples stand for, in model units
  double depth = 0;   ///< the largest distance of these to the surface, in model units
};

struct Findings {
  std::vector<Exit> exits;    ///< the edges, ascending, then the nodes, ascending
  std::vector<Branch> spurs;  ///< those that Certificate::spurs counts
};

/// Looks at the samples that `evaluate` takes with the same options: the lengths of all exits make
/// up the share of the curve that is not inside, the deepest is Certificate::deepest_exit.
/// `diagonal` is that of the surface's bounding box, D. A few microseconds per sample.
/// Throws Error(Fault::input) if a node's position is no finite number.
[[nodiscard]] Findings findings(const SurfaceTree& tree, double diagonal,
                                const CurveSkeleton& skeleton, const CertificateOptions& options,
                                const Monitor& monitor);

}  // namespace curveskel
