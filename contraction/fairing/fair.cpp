#include <curveskel/fair.hpp>

#include <cmath>
#include <string>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/restore_volume.hpp"

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

/// Frames for a monitor; nothing is measured if the monitor does not look.
class FrameSequence {
 public:
  FrameSequence(const Surface& first, const Monitor& monitor) : monitor_(monitor) {
    if (!monitor.frame) return;
    area_ = area(first);
    volume_ = std::abs(volume(first));
    show(0, first);
  }
  void show(int iteration, const Surface& now) const {
    if (!monitor_.frame) return;
    monitor_.frame({"fair", 0, iteration, ratio(area(now), area_),
                    ratio(std::abs(volume(now)), volume_), 0, now});
  }

 private:
  static double ratio(double now, double first) { return first > 0 ? now / first : 1; }

  const Monitor& monitor_;
  double area_ = 0;
  double volume_ = 0;
};

}  // namespace

FairMethod choose_fair_method(FairMethod wanted) {
  return wanted == FairMethod::automatic ? FairMethod::host : wanted;
}

void require_valid(const FairOptions& options) {
  constexpr OptionRange rings{1, 1e6};
  constexpr OptionRange smoothing{0, 1e6};
  const OptionCheck check("FairOptions");
  check.choice("method", options.method, fair_methods);
  check.number("iterations", options.iterations, iteration_range);
  check.number("rings", options.rings, rings);
  check.choice("local_solver", options.local_solver, local_solvers);
  check.number("smoothing", options.smoothing, smoothing);
  check.choice("volume", options.volume, volume_rules);
  check.number("threads", options.threads, thread_range);
}

Surface fair(const Surface& surface, const FairOptions& options, const Monitor& monitor) {
  require_valid(options);
  if (surface.triangles.rows() == 0) return surface;
  require_sound(surface, "fair");
  monitor.report("fair", 0);
  const FrameSequence frames(surface, monitor);
  const double diagonal = bounding_box_diagonal(surface.positions);
  if (options.iterations <= 0 || !(diagonal > 0)) return surface;

  // A power of two changes no digit, so the scale of the input does not show in the result.
  const double scale = std::exp2(-std::ceil(std::log2(diagonal)));
  const Eigen::RowVector3d origin =
      (surface.positions.colwise().minCoeff() + surface.positions.colwise().maxCoeff()) / 2;
  const Surface start{(surface.positions.rowwise() - origin) * scale, surface.triangles};
  const OneRings rings = one_rings(start.triangles, start.positions.rows());
  if (rings.neighbours.empty()) return surface;
  std::vector<bool> held(rings.vertices());
  for (std::size_t v = 0; v < held.size(); ++v) held[v] = rings.of(v).empty();

  const auto flow = make_flow(start, rings, options);
  const auto finished = [&] {
    Surface result{flow->positions(), surface.triangles};
    restore_volume(result, start.positions, held, options.volume);
    result.positions = (result.positions / scale).rowwise() + origin;
    for (std::size_t v = 0; v < held.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      if (held[v]) result.positions.row(row) = surface.positions.row(row);
    }
    return result;
  };
  if (monitor.frame) {
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
      flow->advance(1, of_one_iteration(monitor, iteration, options.iterations));
      frames.show(iteration + 1, finished());
    }
  } else {
    flow->advance(options.iterations, monitor);
  }
  Surface result = finished();
  monitor.report("fair", 1);
  return result;
}

}  // namespace curveskel
