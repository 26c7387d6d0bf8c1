// The paper's local OpenCL method, with the positions resident on the device between iterations.
#include <string>
#include <vector>

#include "contraction/fairing_device.hpp"
#include "contraction/local_flow.hpp"
#include "contraction/opencl.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

template <typename Real>
class OpenClFlow final : public LocalFlow {
 public:
  OpenClFlow(const Surface& surface, const OneRings& rings, const FairOptions& options)
      : session_(fairing_device(options)),
        vertices_(static_cast<int>(surface.positions.rows())),
        stream_(build(options).kernel("one_ring_stream")) {
    const std::vector<Real> packed = pack_positions<Real>(surface.positions);
    now_ = session_.upload(packed);
    next_ = session_.upload(packed);
    start_ = session_.upload(std::vector<int>(rings.start.begin(), rings.start.end()));
    ring_ = session_.upload(rings.neighbours);
    smoothing_ = static_cast<Real>(options.smoothing);
  }

  void advance(int iterations, const Monitor& monitor) override {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      monitor.report("fair", static_cast<double>(iteration) / iterations);
      stream_.set(now_, next_, start_, ring_, 0, vertices_, smoothing_);
      constexpr std::size_t group = 64;
      const auto groups = (static_cast<std::size_t>(vertices_) + group - 1) / group;
      session_.launch(stream_, groups * group, group);
      std::swap(now_, next_);
    }
    session_.finish();
  }

  Positions positions() override {
    std::vector<Real> packed(4 * static_cast<std::size_t>(vertices_));
    session_.read(now_, packed.data(), packed.size() * sizeof(Real));
    return unpack_positions(packed);
  }

  void copy_through_host() override {
    std::vector<Real> packed(4 * static_cast<std::size_t>(vertices_));
    session_.read(now_, packed.data(), packed.size() * sizeof(Real));
    session_.write(now_, packed.data(), packed.size() * sizeof(Real));
  }

 private:
  opencl::Program build(const FairOptions& options) {
    const std::string stored = sizeof(Real) == sizeof(float) ? "float" : "double";
    const std::string real = session_.device().double_precision ? "double" : "float";
    return session_.build(one_ring_stream_source, "-DREAL=" + real + " -DSTORED=" + stored,
                          options.program_cache);
  }

  opencl::Session session_;
  int vertices_;
  opencl::Kernel stream_;
  opencl::Buffer now_, next_, start_, ring_;
  Real smoothing_ = 1;
};

}  // namespace

std::unique_ptr<LocalFlow> make_opencl_flow(const Surface& surface, const OneRings& rings,
                                            const FairOptions& options) {
  if (options.double_precision)
    return std::make_unique<OpenClFlow<double>>(surface, rings, options);
  return std::make_unique<OpenClFlow<float>>(surface, rings, options);
}

}  // namespace curveskel
