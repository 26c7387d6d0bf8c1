// The local flow by a QR per patch, on all cores of the host. Patches are found anew each time:
// that costs little beside the QR, and nothing of their size is kept.
#include "base/parallel.hpp"
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/patch_solution.hpp"

namespace curveskel {
namespace {

class PatchFlow final : public LocalFlow {
 public:
  PatchFlow(const Surface& surface, const OneRings& rings, const FairOptions& options)
      : triangles_(surface.triangles),
        rings_(rings),
        options_(options),
        corners_(corners_by_vertex(surface.triangles, surface.positions.rows())),
        now_(surface.positions),
        next_(now_) {}

  void advance(int iterations, const Monitor& monitor) override {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      // In parts, so that the monitor hears of them.
      constexpr std::size_t vertices_per_report = 16384;
      for (std::size_t begin = 0; begin < rings_.vertices(); begin += vertices_per_report) {
        const double part = static_cast<double>(begin) / static_cast<double>(rings_.vertices());
        monitor.report("fair", (iteration + part) / iterations);
        move(begin, std::min(begin + vertices_per_report, rings_.vertices()), monitor);
      }
      now_.swap(next_);
    }
  }

  Positions positions() override { return now_; }

 private:
  void move(std::size_t first, std::size_t end, const Monitor& monitor) {
    constexpr std::size_t grain = 512;
    parallel_for(end - first, grain, options_.threads, [&](std::size_t from, std::size_t to) {
      PatchFinder patches(triangles_, corners_, options_.rings);
      for (std::size_t v = first + from; v < first + to; ++v) {
        throw_if_stopped(monitor.stop);
        if (rings_.of(v).empty()) continue;
        const auto row = static_cast<Eigen::Index>(v);
        next_.row(row) = now_.row(row) + centre_step(patches.of(static_cast<std::int32_t>(v)), now_,
                                                     options_.smoothing);
      }
    });
  }

  const Triangles& triangles_;
  const OneRings& rings_;
  const FairOptions& options_;
  CornersByVertex corners_;
  Positions now_;
  Positions next_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_patch_flow(const Surface& surface, const OneRings& rings,
                                           const FairOptions& options) {
  return std::make_unique<PatchFlow>(surface, rings, options);
}

}  // namespace curveskel
