// The paper's local OpenCL method, with the positions resident on the device between iterations.
#include <string>
#include <vector>

#include "contraction/device/opencl.hpp"
#include "contraction/fairing/device/fairing_device.hpp"
#include "contraction/fairing/device/position_memory.hpp"
#include "contraction/fairing/least_height.hpp"
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/wide_flow.hpp"
#include "contraction/fairing/wide_slices.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

template <typename Real>
class OpenClFlow final : public LocalFlow {
 public:
  OpenClFlow(const Surface& surface, const OneRings& rings, const FairOptions& options)
      : memory_(place_positions(options, pack_positions<Real>(surface.positions))),
        vertices_(static_cast<int>(surface.positions.rows())),
        stream_(build(options).kernel("one_ring_stream")) {
    const opencl::Session& session = memory_.session;
    start_ = session.upload(std::vector<int>(rings.start.begin(), rings.start.end()));
    ring_ = session.upload(rings.neighbours);
    smoothing_ = static_cast<Real>(options.smoothing);
  }

  void advance(int iterations, const Monitor& monitor) override {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      monitor.report("fair", static_cast<double>(iteration) / iterations);
      acquire(memory_);
      stream_.set(memory_.now, memory_.next, start_, ring_, 0, vertices_, smoothing_);
      constexpr std::size_t group = 64;
      const auto groups = (static_cast<std::size_t>(vertices_) + group - 1) / group;
      memory_.session.launch(stream_, groups * group, group);
      release(memory_);
      std::swap(memory_.now, memory_.next);
    }
    memory_.session.finish();
  }

  Positions positions() override {
    return unpack_positions(read_positions<Real>(memory_, vertices_));
  }

  void copy_through_host() override {
    write_positions(memory_, read_positions<Real>(memory_, vertices_));
  }

 private:
  opencl::Program build(const FairOptions& options) {
    const std::string stored = sizeof(Real) == sizeof(float) ? "float" : "double";
    const std::string real = memory_.session.device().double_precision ? "double" : "float";
    return memory_.session.build(
        one_ring_stream_source,
        "-DREAL=" + real + " -DSTORED=" + stored + std::string(least_height_option),
        options.program_cache);
  }

  PositionMemory memory_;
  int vertices_;
  opencl::Kernel stream_;
  opencl::Buffer start_, ring_;
  Real smoothing_ = 1;
};

}  // namespace

std::unique_ptr<LocalFlow> make_opencl_flow(const Surface& surface, const OneRings& rings,
                                            const FairOptions& options) {
  if (options.double_precision) {
    return std::make_unique<OpenClFlow<double>>(surface, rings, options);
  }
  // OpenGL draws the vertices in their own order, which the wide kernel changes.
  if (options.method == FairMethod::opencl_interop) {
    return std::make_unique<OpenClFlow<float>>(surface, rings, options);
  }
  const std::size_t device = fairing_device(options);
  constexpr std::size_t usual_valence = 6;
  if (local_kernel(devices()[device].gpu, false, usual_valence) == LocalKernel::wide) {
    return make_wide_flow(surface, rings, options, device);
  }
  return std::make_unique<OpenClFlow<float>>(surface, rings, options);
}

}  // namespace curveskel
