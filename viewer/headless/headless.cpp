#include "viewer/headless/headless.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <array>
#include <string>

#include <curveskel/error.hpp>

namespace curveskel::viewer {
namespace {

constexpr const char* remedy =
    "; install libegl1 and libgl1-mesa-dri (Mesa's software renderer will do)";

/// The surfaceless platform needs no graphics card at all; the default display is the last resort.
EGLDisplay started_display() {
  const auto started = [](EGLDisplay display) {
    return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
  };
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      const EGLDisplay display = eglGetPlatformDisplayEXT(
          EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr);
      if (started(display)) return display;
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (started(display)) return display;
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  return started(display) ? display : EGL_NO_DISPLAY;
}

}  // namespace

struct HeadlessContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  State() {
    // epoxy ends the process where the library is missing, so it is looked for first.
    void* const library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) {
      throw Error(Fault::device, std::string("no libEGL.so.1 to draw without a window") + remedy);
    }
    display = started_display();
    if (display == EGL_NO_DISPLAY) {
      throw Error(Fault::device, std::string("EGL started on no device") + remedy);
    }
    constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
    eglChooseConfig(display, wanted.data(), &config, 1, &count);
    if (count > 0 && eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
      context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    }
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
      throw Error(Fault::device, std::string("EGL has no OpenGL 3.3 core here") + remedy);
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }
};

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {}
HeadlessContext::~HeadlessContext() = default;
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;

}  // namespace curveskel::viewer
