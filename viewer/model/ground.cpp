#include "viewer/model/ground.hpp"

#include <utility>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>

namespace curveskel::viewer {

std::shared_ptr<const RepairedSurface> repaired_of(const Document& document,
                                                   std::shared_ptr<const RepairedSurface> known,
                                                   const RepairOptions& options,
                                                   const Monitor& monitor) {
  if (known) return known;
  return std::make_shared<const RepairedSurface>(repair(*document.polygons(), options, monitor));
}

std::shared_ptr<const Ground> ground_of(std::shared_ptr<const RepairedSurface> repaired,
                                        const Monitor& monitor,
                                        std::shared_ptr<const Ground> known) {
  if (known && known->repaired == repaired) return known;
  const Surface& surface = repaired->surface;
  const Topology counted = topology(surface);
  throw_if_stopped(monitor.stop);
  SurfaceTree tree(surface);
  throw_if_stopped(monitor.stop);
  const double diagonal = bounding_box_diagonal(surface.positions);
  return std::make_shared<const Ground>(Ground{std::move(repaired), std::move(tree), diagonal,
                                               counted.components(), counted.total_genus()});
}

Certificate certificate_of(const Ground& ground, const CurveSkeleton& skeleton,
                           const CertificateOptions& options, const Monitor& monitor) {
  Certificate found = evaluate(
      {ground.repaired->surface, ground.tree, ground.diagonal, ground.components, ground.genus},
      skeleton, options, monitor);
  found.wrap_followed = ground.repaired->repairs.wrap_followed;
  return found;
}

}  // namespace curveskel::viewer
