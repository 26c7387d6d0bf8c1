#include "contraction/fairing/wide_flow.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "contraction/device/opencl.hpp"
#include "contraction/fairing/least_height.hpp"
#include "contraction/fairing/wide_slices.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

using StoredPosition = std::array<float, 4>;

constexpr std::size_t places_per_range = 16384;
constexpr std::size_t slices_per_item = 2;

class WideFlow final : public LocalFlow {
 public:
  WideFlow(const Surface& surface, const OneRings& rings, const FairOptions& options,
           std::size_t device)
      : session_(device),
        threads_(options.threads),
        vertices_(surface.positions.rows()),
        slices_(wide_slices(surface.positions, rings, options.threads)),
        smoothing_(static_cast<float>(options.smoothing)) {
    const std::vector<StoredPosition> packed = pack(surface.positions);
    now_ = session_.upload(packed);
    next_ = session_.upload(packed);
    if (slices_.slices() > 0) {
      wide_ = build_wide(options);
      first_row_ = session_.upload(slices_.first_row);
      ring_ = session_.upload(slices_.ring);
    }
    if (slices_.large() > 0) {
      stream_ = build_stream(options);
      large_start_ = session_.upload(slices_.large_start);
      large_ring_ = session_.upload(slices_.large_ring);
    }
  }

  void advance(int iterations, const Monitor& monitor) override {
    // The queue is waited for now and then, so that a request to stop is obeyed soon.
    const int iterations_per_wait =
        static_cast<int>(std::max<Eigen::Index>(1, 4'000'000 / vertices_));
    for (int iteration = 0; iteration < iterations; ++iteration) {
      if (iteration % iterations_per_wait == 0) {
        session_.finish();
        monitor.report("fair", static_cast<double>(iteration) / iterations);
      }
      iterate();
    }
    session_.finish();
  }

  Positions positions() override {
    std::vector<StoredPosition> packed(slices_.vertex_at.size());
    session_.read(now_, packed.data(), packed.size() * sizeof packed[0]);
    Positions result(vertices_, 3);
    for (std::size_t i = 0; i < packed.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        result(slices_.vertex_at[i], k) =
            static_cast<double>(packed[i][static_cast<std::size_t>(k)]);
      }
    }
    return result;
  }

  void copy_through_host() override {
    std::vector<StoredPosition> packed(slices_.vertex_at.size());
    session_.read(now_, packed.data(), packed.size() * sizeof packed[0]);
    session_.write(now_, packed.data(), packed.size() * sizeof packed[0]);
  }

 private:
  void iterate() {
    if (wide_) {
      const std::size_t count = slices_.slices();
      wide_->set(now_, next_, first_row_, ring_, static_cast<int>(count), smoothing_);
      // Groups of one, as the items of a group each have private memory of their own.
      session_.launch(*wide_, (count + slices_per_item - 1) / slices_per_item, 1);
    }
    if (stream_) {
      const std::size_t count = slices_.large();
      const auto first = static_cast<int>(slice_lanes * slices_.slices());
      stream_->set(now_, next_, large_start_, large_ring_, first, static_cast<int>(count),
                   smoothing_);
      session_.launch(*stream_, count, 1);
    }
    std::swap(now_, next_);
  }

  std::vector<StoredPosition> pack(const Positions& positions) const {
    std::vector<StoredPosition> packed(slices_.vertex_at.size());
    parallel_for(packed.size(), places_per_range, threads_,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     const auto p = positions.row(slices_.vertex_at[i]).cast<float>();
                     packed[i] = {p.x(), p.y(), p.z(), 0};
                   }
                 });
    return packed;
  }

  opencl::Kernel build_wide(const FairOptions& options) const {
    return session_
        .build(one_ring_wide_source,
               "-DLARGEST_RING=" + std::to_string(largest_wide_ring) + " -DSLICES_PER_ITEM=" +
                   std::to_string(slices_per_item) + std::string(least_height_option),
               options.program_cache)
        .kernel("one_ring_wide");
  }

  opencl::Kernel build_stream(const FairOptions& options) const {
    const std::string real = session_.device().double_precision ? "double" : "float";
    return session_
        .build(one_ring_stream_source,
               "-DREAL=" + real + " -DSTORED=float" + std::string(least_height_option),
               options.program_cache)
        .kernel("one_ring_stream");
  }

  opencl::Session session_;
  int threads_;
  Eigen::Index vertices_;
  WideSlices slices_;
  float smoothing_;
  std::optional<opencl::Kernel> wide_, stream_;
  opencl::Buffer now_, next_, first_row_, ring_, large_start_, large_ring_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_wide_flow(const Surface& surface, const OneRings& rings,
                                          const FairOptions& options, std::size_t device) {
  return std::make_unique<WideFlow>(surface, rings, options, device);
}

}  // namespace curveskel
