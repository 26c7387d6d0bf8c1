// The local flow by a QR per patch on an OpenCL device. Patches go in batches of similar size:
// small ones in private memory, larger ones in a workspace, and the few giant ones another way.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include "base/parallel.hpp"
#include "contraction/device/opencl.hpp"
#include "contraction/fairing/device/fairing_device.hpp"
#include "contraction/fairing/device/position_memory.hpp"
#include "contraction/fairing/least_height.hpp"
#include "contraction/fairing/local_flow.hpp"
#include "contraction/fairing/patch_solution.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

/// A patch of n vertices goes to the first class with more than n slots; 0 = the workspace.
constexpr std::array<int, 4> slot_classes{8, 16, 32, 0};
/// Above this a QR takes one work-item a tenth of a second or more.
constexpr std::size_t largest_patch_on_device = 511;
constexpr double operations_per_launch = 1e9;  // some 0.1 s, after which a stop is noticed
constexpr std::size_t indices_per_batch = std::size_t{1} << 24U;
constexpr std::size_t largest_workspace_bytes = std::size_t{1} << 28U;

std::size_t class_of(std::size_t patch_size) {
  std::size_t i = 0;
  while (slot_classes[i] != 0 && patch_size >= static_cast<std::size_t>(slot_classes[i])) ++i;
  return i;
}

/// Numbers of the kernel's real8 in one column: n + 1 slots.
std::size_t column_vectors(std::size_t patch_size) { return (patch_size + 8) / 8; }

struct PatchSize {
  std::int32_t centre;
  std::size_t vertices;
  std::size_t triangles;
};

/// Those of one class whose indices are on the device together.
struct Batch {
  std::size_t slot_class = 0;
  int patches = 0;
  int vectors = 0;  // of the largest patch's columns
  opencl::Buffer vertex_start, vertices, triangle_start, triangles;
};

/// The indices of a batch as they are collected.
struct BatchIndices {
  std::vector<int> vertex_start{0}, vertices, triangle_start{0}, triangles;

  void add(const Patch& patch) {
    vertices.insert(vertices.end(), patch.vertices.begin(), patch.vertices.end());
    for (const auto& t : patch.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
    vertex_start.push_back(static_cast<int>(vertices.size()));
    triangle_start.push_back(static_cast<int>(triangles.size() / 3));
  }
  [[nodiscard]] std::size_t patches() const { return vertex_start.size() - 1; }
};

/// A giant one-ring, which the closed form takes.
struct GiantRing {
  std::int32_t centre;
  opencl::Buffer start, ring;
};

template <typename Real>
class OpenClPatchFlow final : public LocalFlow {
 public:
  OpenClPatchFlow(const Surface& surface, const OneRings& rings, const FairOptions& options,
                  const std::stop_token& stop, std::size_t memory_bytes)
      : memory_(place_positions(options, pack_positions<Real>(surface.positions))),
        options_(options),
        lent_bytes_(memory_bytes > 0 ? memory_bytes : session().device().memory_bytes / 2),
        vertices_(surface.positions.rows()),
        triangles_(surface.triangles),
        corners_(corners_by_vertex(surface.triangles, vertices_)),
        patches_(surface.triangles, corners_, options.rings),
        smoothing_(static_cast<Real>(options.smoothing)) {
    place_all(rings, stop);
  }

  void advance(int iterations, const Monitor& monitor) override {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      monitor.report("fair", static_cast<double>(iteration) / iterations);
      const std::vector<Real> giants = giants_moved_on_host(monitor);
      acquire(memory_);
      put_giants(giants);
      move_giants_in_closed_form();
      for (std::size_t i = 0; i < batches_.size(); ++i) {
        launch(batches_[i]);
        session().finish();
        const double part = static_cast<double>(i + 1) / static_cast<double>(batches_.size());
        monitor.report("fair", (iteration + part) / iterations);
      }
      release(memory_);
      std::swap(memory_.now, memory_.next);
    }
    session().finish();
  }

  Positions positions() override {
    return unpack_positions(read_positions<Real>(memory_, vertices_));
  }

  void copy_through_host() override {
    write_positions(memory_, read_positions<Real>(memory_, vertices_));
  }

 private:
  /// Chooses the way of moving each vertex, and uploads its data.
  void place_all(const OneRings& rings, const std::stop_token& stop) {
    std::array<std::vector<PatchSize>, slot_classes.size()> by_class;
    for (std::size_t v = 0; v < rings.vertices(); ++v) {
      throw_if_stopped(stop);
      const auto ring = rings.of(v);
      if (ring.empty()) continue;
      const auto centre = static_cast<std::int32_t>(v);
      const Patch& patch = patches_.of(centre);
      const PatchSize size{centre, patch.vertices.size(), patch.triangles.size()};
      if (size.vertices <= largest_patch_on_device) {
        by_class[class_of(size.vertices)].push_back(size);
      } else if (options_.rings == 1) {
        const std::vector<int> start{0, static_cast<int>(ring.size())};
        giant_rings_.push_back({centre, session().upload(start), session().upload(ring)});
      } else {
        on_host_.push_back(centre);
      }
    }
    std::stable_sort(by_class.back().begin(), by_class.back().end(),
                     [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
    check_memory(by_class);
    for (std::size_t i = 0; i < by_class.size(); ++i) {
      if (!by_class[i].empty()) make_batches(i, by_class[i], stop);
    }
    if (!giant_rings_.empty()) stream_.emplace(build_stream().kernel("one_ring_stream"));
    if (!on_host_.empty()) {
      if (!kernels_[0]) build_class(0);
      giants_ = session().upload(on_host_);
      giant_values_ = session().allocate(4 * on_host_.size() * sizeof(Real));
    }
  }

  template <typename ByClass>
  void check_memory(const ByClass& by_class) const {
    std::size_t indices = 0;
    for (const auto& sizes : by_class) {
      for (const PatchSize& size : sizes) indices += size.vertices + 3 * size.triangles + 2;
    }
    const std::size_t needed = indices * sizeof(int) + workspace_limit();
    if (needed > lent_bytes_) {
      constexpr std::size_t mebibyte = std::size_t{1} << 20U;
      throw Error(Fault::device, "the patches of " + std::to_string(options_.rings) +
                                     " rings need " + std::to_string(needed / mebibyte) +
                                     " MiB on OpenCL device '" + session().device().name +
                                     "', which lends " + std::to_string(lent_bytes_ / mebibyte) +
                                     "; use fewer rings, or the method host, which keeps none");
    }
  }

  [[nodiscard]] std::size_t workspace_limit() const {
    return std::min(largest_workspace_bytes, session().device().memory_bytes / 16);
  }

  void make_batches(std::size_t slot_class, const std::vector<PatchSize>& sizes,
                    const std::stop_token& stop) {
    build_class(slot_class);
    BatchIndices indices;
    double operations = 0;
    std::size_t largest = 0;
    const auto close = [&] {
      batches_.push_back(
          {slot_class, static_cast<int>(indices.patches()),
           static_cast<int>(column_vectors(largest)), session().upload(indices.vertex_start),
           session().upload(indices.vertices), session().upload(indices.triangle_start),
           session().upload(indices.triangles)});
      workspace_bytes_ =
          std::max(workspace_bytes_, bytes_in_workspace(slot_class, indices.patches(), largest));
      indices = {};
      operations = 0;
    };
    for (const PatchSize& size : sizes) {
      throw_if_stopped(stop);
      const std::size_t next_largest = std::max(largest, size.vertices);
      const bool full =
          indices.vertices.size() + indices.triangles.size() > indices_per_batch ||
          operations > operations_per_launch ||
          bytes_in_workspace(slot_class, indices.patches() + 1, next_largest) > workspace_limit();
      if (full && indices.patches() > 0) close();
      largest = next_largest;
      indices.add(patches_.of(size.centre));
      const auto n = static_cast<double>(size.vertices);
      operations += 2 * n * n * (n + 5);
    }
    close();
    if (slot_classes[slot_class] == 0) workspace_ = session().allocate(workspace_bytes_);
  }

  static std::size_t bytes_in_workspace(std::size_t slot_class, std::size_t patches,
                                        std::size_t largest) {
    if (slot_classes[slot_class] != 0) return 0;
    const std::size_t vectors = column_vectors(largest);
    return patches * vectors * (8 * vectors + 2) * 8 * sizeof(Real);
  }

  void launch(const Batch& batch) {
    opencl::Kernel& kernel = *kernels_[batch.slot_class];
    const bool in_workspace = slot_classes[batch.slot_class] == 0;
    if (in_workspace) {
      kernel.set(memory_.now, memory_.next, batch.vertex_start, batch.vertices,
                 batch.triangle_start, batch.triangles, batch.patches, smoothing_, workspace_,
                 batch.vectors);
    } else {
      kernel.set(memory_.now, memory_.next, batch.vertex_start, batch.vertices,
                 batch.triangle_start, batch.triangles, batch.patches, smoothing_);
    }
    // A processor has no use for groups where each item has so much to do.
    const std::size_t group = in_workspace && !session().device().gpu ? 1 : 32;
    const auto groups = (static_cast<std::size_t>(batch.patches) + group - 1) / group;
    session().launch(kernel, groups * group, group);
  }

  void move_giants_in_closed_form() {
    for (const GiantRing& giant : giant_rings_) {
      stream_->set(memory_.now, memory_.next, giant.start, giant.ring,
                   static_cast<int>(giant.centre), 1, smoothing_);
      session().launch(*stream_, 1, 1);
    }
  }

  std::vector<Real> giants_moved_on_host(const Monitor& monitor) {
    if (on_host_.empty()) return {};
    const Positions now = positions();
    Positions moved(static_cast<Eigen::Index>(on_host_.size()), 3);
    constexpr std::size_t grain = 8;  // a patch takes a hundredth of a second or more
    parallel_for(on_host_.size(), grain, options_.threads, [&](std::size_t begin, std::size_t end) {
      PatchFinder patches(triangles_, corners_, options_.rings);
      for (std::size_t i = begin; i < end; ++i) {
        throw_if_stopped(monitor.stop);
        const std::int32_t v = on_host_[i];
        moved.row(static_cast<Eigen::Index>(i)) =
            now.row(v) + centre_step(patches.of(v), now, options_.smoothing);
      }
    });
    return pack_positions<Real>(moved);
  }

  void put_giants(const std::vector<Real>& moved) {
    if (moved.empty()) return;
    session().write(giant_values_, moved.data(), moved.size() * sizeof(Real));
    place_->set(memory_.next, giants_, giant_values_, static_cast<int>(on_host_.size()));
    session().launch(*place_, on_host_.size(), 0);
  }

  void build_class(std::size_t slot_class) {
    const opencl::Program program = session().build(
        patch_qr_source,
        "-DREAL=" + real() + " -DSLOTS=" + std::to_string(slot_classes[slot_class]) +
            std::string(least_height_option),
        options_.program_cache);
    kernels_[slot_class].emplace(program.kernel("patch_qr"));
    place_.emplace(program.kernel("place"));
  }

  opencl::Program build_stream() const {
    const std::string arithmetic = session().device().double_precision ? "double" : "float";
    return session().build(
        one_ring_stream_source,
        "-DREAL=" + arithmetic + " -DSTORED=" + real() + std::string(least_height_option),
        options_.program_cache);
  }

  [[nodiscard]] const opencl::Session& session() const { return memory_.session; }

  static std::string real() { return sizeof(Real) == sizeof(float) ? "float" : "double"; }

  PositionMemory memory_;
  const FairOptions& options_;
  std::size_t lent_bytes_;
  Eigen::Index vertices_;
  const Triangles& triangles_;
  CornersByVertex corners_;
  PatchFinder patches_;
  std::array<std::optional<opencl::Kernel>, slot_classes.size()> kernels_;
  std::optional<opencl::Kernel> stream_, place_;
  std::vector<Batch> batches_;
  std::vector<GiantRing> giant_rings_;
  std::vector<std::int32_t> on_host_;
  opencl::Buffer workspace_, giants_, giant_values_;
  std::size_t workspace_bytes_ = 0;
  Real smoothing_ = 1;
};

}  // namespace

std::unique_ptr<LocalFlow> make_opencl_patch_flow(const Surface& surface, const OneRings& rings,
                                                  const FairOptions& options,
                                                  const std::stop_token& stop,
                                                  std::size_t memory_bytes) {
  if (options.double_precision) {
    return std::make_unique<OpenClPatchFlow<double>>(surface, rings, options, stop, memory_bytes);
  }
  return std::make_unique<OpenClPatchFlow<float>>(surface, rings, options, stop, memory_bytes);
}

}  // namespace curveskel
