#include "contraction/device/gl_context.hpp"

#include <dlfcn.h>

#include <array>
#include <string>
#include <vector>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

// From the registries of EGL and OpenGL; their headers are not needed for so little.
using EglAttribute = std::int32_t;
constexpr EglAttribute egl_none = 0x3038;
constexpr EglAttribute egl_surface_type = 0x3033;
constexpr EglAttribute egl_pbuffer_bit = 0x0001;
constexpr EglAttribute egl_renderable_type = 0x3040;
constexpr EglAttribute egl_opengl_bit = 0x0008;
constexpr unsigned egl_opengl_api = 0x30A2;
constexpr unsigned egl_platform_device = 0x313F;
constexpr unsigned gl_array_buffer = 0x8892;
constexpr unsigned gl_dynamic_draw = 0x88E8;

[[noreturn]] void no_context(const std::string& found) {
  throw Error(
      Fault::device,
      "an OpenGL context without a window is needed and " + found +
          "; install libegl1 and the driver of the graphics card, or use the method opencl");
}

/// Never unloaded: drivers do not take that well.
void* egl_library() {
  void* const library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) no_context("libEGL.so.1 could not be loaded");
  return library;
}

template <typename Function>
Function* function_in(void* library, const char* name) {
  void* const found = dlsym(library, name);
  if (found == nullptr) no_context("libEGL.so.1 has no " + std::string(name));
  return reinterpret_cast<Function*>(found);  // what dlsym is made for
}

using Procedure = void (*)();
using GetProcAddress = Procedure(const char*);

template <typename Function>
Function* procedure(GetProcAddress* get, const char* name) {
  return reinterpret_cast<Function*>(get(name));
}

}  // namespace

struct Egl {
  void* library = egl_library();
  GetProcAddress* get = function_in<GetProcAddress>(library, "eglGetProcAddress");

  [[nodiscard]] std::vector<void*> devices() const {
    using QueryDevices = unsigned(EglAttribute, void**, EglAttribute*);
    auto* const query = procedure<QueryDevices>(get, "eglQueryDevicesEXT");
    EglAttribute count = 0;
    if (query == nullptr || query(0, nullptr, &count) == 0) return {};
    std::vector<void*> found(static_cast<std::size_t>(count));
    if (count > 0 && query(count, found.data(), &count) == 0) return {};
    return found;
  }

  /// The display of a device, or the default one for the number after the last device.
  [[nodiscard]] void* display(std::size_t device) const {
    const std::vector<void*> found = devices();
    using GetPlatformDisplay = void*(unsigned, void*, const EglAttribute*);
    auto* const of_platform = procedure<GetPlatformDisplay>(get, "eglGetPlatformDisplayEXT");
    if (device < found.size() && of_platform != nullptr) {
      return of_platform(egl_platform_device, found[device], nullptr);
    }
    return function_in<void*(void*)>(library, "eglGetDisplay")(nullptr);
  }
};

struct GlContext::State {
  Egl egl;
  void* display = nullptr;
  void* context = nullptr;
  std::vector<std::uint32_t> buffers;

  explicit State(std::size_t device) : display(egl.display(device)) {
    const std::string name = "EGL device " + std::to_string(device);
    using Initialize = unsigned(void*, EglAttribute*, EglAttribute*);
    if (display == nullptr ||
        function_in<Initialize>(egl.library, "eglInitialize")(display, nullptr, nullptr) == 0) {
      no_context(name + " did not start");
    }
    constexpr std::array<EglAttribute, 5> wanted{egl_surface_type, egl_pbuffer_bit,
                                                 egl_renderable_type, egl_opengl_bit, egl_none};
    using ChooseConfig = unsigned(void*, const EglAttribute*, void**, EglAttribute, EglAttribute*);
    void* config = nullptr;
    EglAttribute count = 0;
    const bool chosen = function_in<ChooseConfig>(egl.library, "eglChooseConfig")(
                            display, wanted.data(), &config, 1, &count) != 0;
    if (!chosen || count == 0 ||
        function_in<unsigned(unsigned)>(egl.library, "eglBindAPI")(egl_opengl_api) == 0) {
      no_context(name + " has no OpenGL");
    }
    using CreateContext = void*(void*, void*, void*, const EglAttribute*);
    context = function_in<CreateContext>(egl.library, "eglCreateContext")(display, config, nullptr,
                                                                          nullptr);
    if (context == nullptr || make_current(context) == 0) {
      no_context(name + " made no OpenGL context");
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (!buffers.empty()) {
      gl<void(std::int32_t, const std::uint32_t*)>("glDeleteBuffers")(
          static_cast<std::int32_t>(buffers.size()), buffers.data());
    }
    make_current(nullptr);
    function_in<unsigned(void*, void*)>(egl.library, "eglDestroyContext")(display, context);
  }

  unsigned make_current(void* wanted) const {
    using MakeCurrent = unsigned(void*, void*, void*, void*);
    return function_in<MakeCurrent>(egl.library, "eglMakeCurrent")(display, nullptr, nullptr,
                                                                   wanted);
  }

  template <typename Function>
  [[nodiscard]] Function* gl(const char* name) const {
    auto* const found = procedure<Function>(egl.get, name);
    if (found == nullptr) no_context("it has no " + std::string(name));
    return found;
  }
};

GlContext::GlContext(std::size_t egl_device) : state_(std::make_shared<State>(egl_device)) {}

std::uint32_t GlContext::vertex_buffer(const void* from, std::size_t bytes) const {
  std::uint32_t name = 0;
  state_->gl<void(std::int32_t, std::uint32_t*)>("glGenBuffers")(1, &name);
  state_->buffers.push_back(name);
  state_->gl<void(unsigned, std::uint32_t)>("glBindBuffer")(gl_array_buffer, name);
  using BufferData = void(unsigned, std::ptrdiff_t, const void*, unsigned);
  state_->gl<BufferData>("glBufferData")(gl_array_buffer, static_cast<std::ptrdiff_t>(bytes), from,
                                         gl_dynamic_draw);
  if (const unsigned error = state_->gl<unsigned()>("glGetError")(); error != 0) {
    throw Error(Fault::device, "a vertex buffer of " + std::to_string(bytes) +
                                   " bytes was refused by OpenGL (error " + std::to_string(error) +
                                   "); use the method opencl");
  }
  return name;
}

void GlContext::read(std::uint32_t buffer, void* to, std::size_t bytes) const {
  state_->gl<void(unsigned, std::uint32_t)>("glBindBuffer")(gl_array_buffer, buffer);
  using GetBufferSubData = void(unsigned, std::ptrdiff_t, std::ptrdiff_t, void*);
  state_->gl<GetBufferSubData>("glGetBufferSubData")(gl_array_buffer, 0,
                                                     static_cast<std::ptrdiff_t>(bytes), to);
}

void GlContext::finish() const { state_->gl<void()>("glFinish")(); }

void* GlContext::context() const { return state_->context; }
void* GlContext::display() const { return state_->display; }

std::size_t egl_device_count() { return Egl().devices().size() + 1; }

}  // namespace curveskel
