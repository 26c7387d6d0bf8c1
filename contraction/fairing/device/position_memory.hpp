// The positions of a flow on a device: in buffers of OpenCL, or in OpenGL's vertex buffers
// that OpenCL shares (cl_khr_gl_sharing).
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <curveskel/fair.hpp>
#include "contraction/device/opencl.hpp"

namespace curveskel {

struct PositionMemory {
  std::shared_ptr<void> gl;  ///< the OpenGL context, if there is one; it outlives all else
  opencl::Session session;
  opencl::Buffer now, next;  ///< equal to begin with
};

/// On the device of `fairing_device`; throws as that does, and Error(Fault::device) where
/// opencl-interop finds no OpenGL context to share with. `packed` is not empty.
[[nodiscard]] PositionMemory place_positions(const FairOptions& options, const void* packed,
                                             std::size_t bytes);
template <typename Real>
[[nodiscard]] PositionMemory place_positions(const FairOptions& options,
                                             const std::vector<Real>& packed) {
  return place_positions(options, packed.data(), packed.size() * sizeof(Real));
}

/// Between these two OpenCL may use the buffers. Nothing to do for buffers of its own.
void acquire(const PositionMemory& memory);
void release(const PositionMemory& memory);

/// Four numbers a vertex, as `pack_positions` has them.
template <typename Real>
[[nodiscard]] std::vector<Real> read_positions(const PositionMemory& memory,
                                               Eigen::Index vertices) {
  std::vector<Real> packed(4 * static_cast<std::size_t>(vertices));
  acquire(memory);
  memory.session.read(memory.now, packed.data(), packed.size() * sizeof(Real));
  release(memory);
  return packed;
}

template <typename Real>
void write_positions(const PositionMemory& memory, const std::vector<Real>& packed) {
  acquire(memory);
  memory.session.write(memory.now, packed.data(), packed.size() * sizeof(Real));
  release(memory);
}

}  // namespace curveskel
