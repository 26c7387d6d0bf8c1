#include <curveskel/fair.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>
#include "base/option_ranges.hpp"
#include "contraction/fairing/component_boxes.hpp"
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/restore_volume.hpp"

namespace curveskel {
namespace {

std::unique_ptr<LocalFlow> make_flow(const Surface& surface, const OneRings& rings,
                                     const FairOptions& options, const Monitor& monitor) {
  const bool closed_form = options.rings == 1 && options.local_solver == LocalSolver::closed;
  const auto on_device = [&] {
    return closed_form ? make_opencl_flow(surface, rings, options)
                       : make_opencl_patch_flow(surface, rings, options, monitor.stop);
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
    diagonal_ = bounding_box_diagonal(first.positions);
    const Surface measured = scaled(first);
    area_ = area(measured);
    volume_ = std::abs(volume(measured));
    show(0, first);
  }
  void show(int iteration, const Surface& now) const {
    if (!monitor_.frame) return;
    const Surface measured = scaled(now);
    monitor_.frame({"fair", 0, iteration, ratio(area(measured), area_),
                    ratio(std::abs(volume(measured)), volume_), 0, now});
  }

 private:
  static double ratio(double now, double first) { return first > 0 ? now / first : 1; }
  /// To a size whose cube is a number.
  [[nodiscard]] Surface scaled(const Surface& surface) const {
    return {diagonal_ > 0 ? Positions(surface.positions / diagonal_) : surface.positions,
            surface.triangles};
  }

  const Monitor& monitor_;
  double diagonal_ = 1;
  double area_ = 0;
  double volume_ = 0;
};

/// The surface on its way to the flow and back.
class Course {
 public:
  struct Result {
    Surface surface;
    int left = 0;  ///< components that stay as they were, see restore_volume
  };

  Course(const Surface& given, const OneRings& rings, const FairOptions& options)
      : given_(given),
        rule_(options.volume),
        parts_(topology(given)),
        boxes_(given.positions, parts_),
        start_{boxes_.enter(given.positions), given.triangles},
        held_(rings.vertices()) {
    for (std::size_t v = 0; v < held_.size(); ++v) held_[v] = rings.of(v).empty();
  }
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;
  ~Course() = default;

  [[nodiscard]] const Surface& start() const { return start_; }
  [[nodiscard]] int components() const {
    return static_cast<int>(parts_.faces.size() -
                            idx(std::count(parts_.faces.begin(), parts_.faces.end(), 0)));
  }

  /// `reached` is where the flow has taken the vertices of `start`.
  [[nodiscard]] Result finished(Positions reached) const {
    Result result{{std::move(reached), given_.triangles}, 0};
    Positions& positions = result.surface.positions;
    const std::vector<bool> failed =
        restore_volume(result.surface, parts_, start_.positions, held_, rule_);
    result.left = static_cast<int>(std::count(failed.begin(), failed.end(), true));
    positions = boxes_.leave(positions);
    for (std::size_t v = 0; v < held_.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      const bool stays = held_[v] || failed[idx(parts_.component_of_vertex[row])];
      if (stays) positions.row(row) = given_.positions.row(row);
    }
    return result;
  }

 private:
  const Surface& given_;
  VolumeRule rule_;
  Topology parts_;
  ComponentBoxes boxes_;
  Surface start_;
  std::vector<bool> held_;
};

std::string left_as_they_were(int left, int components) {
  const std::string which = components == 1
                                ? "the surface is"
                                : std::to_string(left) + " of " + std::to_string(components) +
                                      (left == 1 ? " components is" : " components are");
  return which + " too coarse to be faired, which would cost " +
         (left == 1 ? "its shape: left as it was" : "their shape: left as they were");
}

void require_measurable(const Positions& positions) {
  if (std::isfinite(bounding_box_diagonal(positions))) return;
  throw Error(Fault::input,
              "fair: the diagonal of the bounding box is above 1.8e308, the largest number there "
              "is; needed a smaller one: scale the surface down");
}

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
  require_measurable(surface.positions);
  monitor.report("fair", 0);
  const FrameSequence frames(surface, monitor);
  if (options.iterations <= 0) return surface;
  const OneRings rings = one_rings(surface.triangles, surface.positions.rows());
  if (rings.neighbours.empty()) return surface;

  const Course course(surface, rings, options);
  const auto flow = make_flow(course.start(), rings, options, monitor);
  if (monitor.frame) {
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
      flow->advance(1, of_one_iteration(monitor, iteration, options.iterations));
      frames.show(iteration + 1, course.finished(flow->positions()).surface);
    }
  } else {
    flow->advance(options.iterations, monitor);
  }
  Course::Result result = course.finished(flow->positions());
  if (result.left > 0) monitor.say(left_as_they_were(result.left, course.components()));
  monitor.report("fair", 1);
  return std::move(result.surface);
}

}  // namespace curveskel
