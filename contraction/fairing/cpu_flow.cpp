// The paper's local CPU method: per vertex, a dense QR of the stacked system of its patch.
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/patch_solution.hpp"

namespace curveskel {
namespace {

/// Above this a dense QR of one patch takes a minute or more.
constexpr std::size_t largest_dense_patch = 1024;

class CpuFlow final : public LocalFlow {
 public:
  CpuFlow(const Surface& surface, const OneRings& rings, const FairOptions& options)
      : rings_(rings),
        smoothing_(options.smoothing),
        corners_(corners_by_vertex(surface.triangles, surface.positions.rows())),
        patches_(surface.triangles, corners_, options.rings),
        now_(surface.positions) {}

  void advance(int iterations, const Monitor& monitor) override {
    constexpr std::size_t vertices_per_report = 64;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      next_ = now_;
      for (std::size_t v = 0; v < rings_.vertices(); ++v) {
        if (v % vertices_per_report == 0) {
          const double part = static_cast<double>(v) / static_cast<double>(rings_.vertices());
          monitor.report("fair", (iteration + part) / iterations);
        }
        throw_if_stopped(monitor.stop);  // a large patch takes a tenth of a second
        if (!rings_.of(v).empty()) move(static_cast<std::int32_t>(v));
      }
      now_.swap(next_);
    }
  }

  Positions positions() override { return now_; }

 private:
  void move(std::int32_t v) {
    const Patch& patch = patches_.of(v);
    next_.row(v) += patch.vertices.size() <= largest_dense_patch
                        ? centre_step_by_full_qr(patch, now_, smoothing_)
                        : centre_step_by_lu(patch, now_, smoothing_);
  }

  const OneRings& rings_;
  double smoothing_;
  CornersByVertex corners_;
  PatchFinder patches_;
  Positions now_;
  Positions next_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_cpu_flow(const Surface& surface, const OneRings& rings,
                                         const FairOptions& options) {
  return std::make_unique<CpuFlow>(surface, rings, options);
}

}  // namespace curveskel
