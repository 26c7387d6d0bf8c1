#include "contraction/fair.hpp"

#include <cmath>
#include <string>

#include "contraction/local_flow.hpp"
#include "contraction/restore_volume.hpp"
#include "surface/error.hpp"
#include "surface/measures.hpp"

namespace curveskel {
namespace {

std::unique_ptr<LocalFlow> make_flow(const Surface& surface, const OneRings& rings,
                                     const FairOptions& options) {
  const bool closed_form = options.rings == 1 && options.local_solver == LocalSolver::closed;
  const auto on_device = [&] {
    return closed_form ? make_opencl_flow(surface, rings, options)
                       : make_opencl_patch_flow(surface, rings, options);
  };
  switch (choose_fair_method(options.method)) {
    case FairMethod::cpu:
      return make_cpu_flow(surface, rings, options);
    case FairMethod::opencl:
    case FairMethod::opencl_interop:
      return on_device();
    case FairMethod::opencl_transfer:
      return make_transfer_flow(on_device());
    case FairMethod::automatic:
    case FairMethod::host:
      break;
  }
  return closed_form ? make_host_flow(surface, rings, options)
                     : make_patch_flow(surface, rings, options);
}

}  // namespace

FairMethod choose_fair_method(FairMethod wanted) {
  return wanted == FairMethod::automatic ? FairMethod::host : wanted;
}

Surface fair(const Surface& surface, const FairOptions& options, const Monitor& monitor) {
  if (options.rings < 1) {
    throw Error(Fault::input, "patches of " + std::to_string(options.rings) +
                                  " rings were asked for; 1 or more are needed");
  }
  monitor.report("fair", 0);
  const double diagonal = bounding_box_diagonal(surface.positions);
  if (options.iterations <= 0 || !(diagonal > 0)) return surface;

  // A power of two changes no digit, so the scale of the input does not show in the result.
  const double scale = std::exp2(-std::ceil(std::log2(diagonal)));
  const Eigen::RowVector3d origin =
      (surface.positions.colwise().minCoeff() + surface.positions.colwise().maxCoeff()) / 2;
  Surface result{(surface.positions.rowwise() - origin) * scale, surface.triangles};
  const Positions before = result.positions;
  const OneRings rings = one_rings(result.triangles, result.positions.rows());
  if (rings.neighbours.empty()) return surface;

  const auto flow = make_flow(result, rings, options);
  flow->advance(options.iterations, monitor);
  result.positions = flow->positions();

  std::vector<bool> held(rings.vertices());
  for (std::size_t v = 0; v < held.size(); ++v) held[v] = rings.of(v).empty();
  restore_volume(result, before, held, options.volume);
  result.positions = (result.positions / scale).rowwise() + origin;
  for (std::size_t v = 0; v < held.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    if (held[v]) result.positions.row(row) = surface.positions.row(row);
  }
  monitor.report("fair", 1);
  return result;
}

}  // namespace curveskel
