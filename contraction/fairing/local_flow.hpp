// The interface of every method of the local flow; one file per method.
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string_view>

#include <curveskel/fair.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include "contraction/fairing/one_rings.hpp"

namespace curveskel {

/// A surface on its way through the flow. Vertices without a ring stay where they are.
class LocalFlow {
 public:
  virtual ~LocalFlow() = default;
  /// Moves all vertices at once, `iterations` times.
  virtual void advance(int iterations, const Monitor& monitor) = 0;
  [[nodiscard]] virtual Positions positions() = 0;
  /// Copies the positions, as they are, from the device to the host and back. Nothing on a host.
  virtual void copy_through_host() {}
};

/// For one of several iterations: its progress is a part of theirs. Refers to `monitor`.
[[nodiscard]] inline Monitor of_one_iteration(const Monitor& monitor, int iteration,
                                              int iterations) {
  Monitor within = monitor;
  within.progress = [&monitor, iteration, iterations](std::string_view stage, double part) {
    if (monitor.progress) monitor.progress(stage, (iteration + part) / iterations);
  };
  return within;
}

/// Positions are expected near the origin with a bounding-box diagonal of about 1; all methods
/// keep a reference to `surface` and `rings`, which must outlive them.
[[nodiscard]] std::unique_ptr<LocalFlow> make_cpu_flow(const Surface& surface,
                                                       const OneRings& rings,
                                                       const FairOptions& options);
[[nodiscard]] std::unique_ptr<LocalFlow> make_host_flow(const Surface& surface,
                                                        const OneRings& rings,
                                                        const FairOptions& options);
[[nodiscard]] std::unique_ptr<LocalFlow> make_opencl_flow(const Surface& surface,
                                                          const OneRings& rings,
                                                          const FairOptions& options);
/// As in `make_host_flow`, by a QR per patch: any number of rings.
[[nodiscard]] std::unique_ptr<LocalFlow> make_patch_flow(const Surface& surface,
                                                         const OneRings& rings,
                                                         const FairOptions& options);
/// On the device, in at most `memory_bytes` of it beside the positions (0 = half of its memory).
/// Throws Error(Fault::device) when the patches need more, Cancelled once `stop` is requested:
/// finding and placing them takes its time.
[[nodiscard]] std::unique_ptr<LocalFlow> make_opencl_patch_flow(const Surface& surface,
                                                                const OneRings& rings,
                                                                const FairOptions& options,
                                                                const std::stop_token& stop,
                                                                std::size_t memory_bytes = 0);
/// The flow of `resident`, with `copy_through_host` after every iteration.
[[nodiscard]] std::unique_ptr<LocalFlow> make_transfer_flow(std::unique_ptr<LocalFlow> resident);

}  // namespace curveskel
