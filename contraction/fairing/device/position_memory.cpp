// No device at hand has cl_khr_gl_sharing: the context of OpenGL and its buffers are tested,
// sharing them with OpenCL has not run on a device so far.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS

#include "contraction/fairing/device/position_memory.hpp"

#include <CL/cl_gl.h>

#include <array>
#include <string>

#include <curveskel/error.hpp>
#include "contraction/device/gl_context.hpp"
#include "contraction/fairing/device/fairing_device.hpp"

namespace curveskel {
namespace {

void check_sharing(cl_int code, const std::string& call) {
  if (code == CL_SUCCESS) return;
  throw Error(Fault::device, call + " failed with OpenCL error " + std::to_string(code) +
                                 "; use the method opencl, which shares nothing with OpenGL");
}

opencl::Buffer share(const opencl::Session& session, std::uint32_t gl_buffer, std::size_t bytes) {
  cl_int code = CL_SUCCESS;
  cl_mem raw = clCreateFromGLBuffer(static_cast<cl_context>(session.context()), CL_MEM_READ_WRITE,
                                    gl_buffer, &code);
  check_sharing(code, "sharing a vertex buffer of OpenGL");
  return {{raw, clReleaseMemObject}, bytes};
}

PositionMemory place_in_vertex_buffers(std::size_t device, const GlContext& gl, const void* packed,
                                       std::size_t bytes) {
  const std::array<std::intptr_t, 4> sharing{
      CL_GL_CONTEXT_KHR, reinterpret_cast<std::intptr_t>(gl.context()), CL_EGL_DISPLAY_KHR,
      reinterpret_cast<std::intptr_t>(gl.display())};
  PositionMemory memory{std::make_shared<GlContext>(gl), opencl::Session(device, sharing), {}, {}};
  const std::uint32_t now = gl.vertex_buffer(packed, bytes);
  const std::uint32_t next = gl.vertex_buffer(packed, bytes);
  gl.finish();
  memory.now = share(memory.session, now, bytes);
  memory.next = share(memory.session, next, bytes);
  return memory;
}

/// A machine has several displays and OpenCL shares with those of its own device only: the first
/// that it takes.
PositionMemory place_in_vertex_buffers(std::size_t device, const void* packed, std::size_t bytes) {
  const std::size_t displays = egl_device_count();
  for (std::size_t i = 0;; ++i) {
    try {
      return place_in_vertex_buffers(device, GlContext(i), packed, bytes);
    } catch (const Error&) {
      if (i + 1 == displays) throw;
    }
  }
}

template <typename Enqueue>
void hand_over(const PositionMemory& memory, Enqueue enqueue, const char* call) {
  if (!memory.gl) return;
  const std::array<cl_mem, 2> buffers{static_cast<cl_mem>(memory.now.handle.get()),
                                      static_cast<cl_mem>(memory.next.handle.get())};
  check_sharing(enqueue(static_cast<cl_command_queue>(memory.session.queue()), 2, buffers.data(), 0,
                        nullptr, nullptr),
                call);
}

}  // namespace

PositionMemory place_positions(const FairOptions& options, const void* packed, std::size_t bytes) {
  const std::size_t device = fairing_device(options);
  if (options.method == FairMethod::opencl_interop) {
    return place_in_vertex_buffers(device, packed, bytes);
  }
  PositionMemory memory{nullptr, opencl::Session(device), {}, {}};
  for (opencl::Buffer* buffer : {&memory.now, &memory.next}) {
    *buffer = memory.session.allocate(bytes);
    memory.session.write(*buffer, packed, bytes);
  }
  return memory;
}

void acquire(const PositionMemory& memory) {
  if (memory.gl) std::static_pointer_cast<GlContext>(memory.gl)->finish();
  hand_over(memory, clEnqueueAcquireGLObjects, "acquiring OpenGL's vertex buffers");
}

void release(const PositionMemory& memory) {
  hand_over(memory, clEnqueueReleaseGLObjects, "releasing OpenGL's vertex buffers");
  if (memory.gl) memory.session.finish();
}

}  // namespace curveskel
