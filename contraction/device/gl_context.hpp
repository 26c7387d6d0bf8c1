// An OpenGL context without a window, and buffers in it; libEGL is loaded only when one is made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace curveskel {

/// Current on the thread that made it, until it is destroyed there. Copies share it.
class GlContext {
 public:
  /// On the EGL device with this number, in EGL's order. Throws Error(Fault::device) where there is
  /// no libEGL, no such device, or no OpenGL on it.
  explicit GlContext(std::size_t egl_device);

  /// The name of a vertex buffer that holds these bytes.
  [[nodiscard]] std::uint32_t vertex_buffer(const void* from, std::size_t bytes) const;
  void read(std::uint32_t buffer, void* to, std::size_t bytes) const;
  /// Waits until OpenGL has done all it was told to.
  void finish() const;

  /// EGLContext and EGLDisplay.
  [[nodiscard]] void* context() const;
  [[nodiscard]] void* display() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// The number of EGL's devices, the default display among them: at least 1. Throws as above without
/// libEGL.
[[nodiscard]] std::size_t egl_device_count();

}  // namespace curveskel
