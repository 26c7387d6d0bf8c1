#include "viewer/window/glfw_window.hpp"

#include <epoxy/gl.h>
// OpenGL's functions are epoxy's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <curveskel/error.hpp>
#include "viewer/render/gl_objects.hpp"

namespace curveskel::viewer {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "unknown" : text;
}

[[noreturn]] void no_window(const std::string& why) {
  throw Error(Fault::device, why + "; without a display, use --screenshot or --turntable");
}

bool draws_in_software() {
  const std::string name = gl_name();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
         name.find("swrast") != std::string::npos;
}

/// True if one buffer is drawn into and copied from, frame after frame: three pixels of as many
/// frames are all there in the end.
bool keeps_what_is_drawn(GLFWwindow* window) {
  constexpr std::size_t frames = 3;
  glEnable(GL_SCISSOR_TEST);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    glScissor(static_cast<GLint>(frame), 0, 1, 1);
    glClearColor(0.2F * static_cast<float>(frame + 1), 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glfwSwapBuffers(window);
  }
  glDisable(GL_SCISSOR_TEST);
  std::array<std::uint8_t, 4 * frames> pixels{};
  glReadPixels(0, 0, static_cast<GLsizei>(frames), 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const int wanted = 51 * static_cast<int>(frame + 1);
    if (std::abs(pixels[4 * frame] - wanted) > 2) return false;
  }
  return true;
}

GlfwWindow& owner_of(GLFWwindow* window) {
  return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
}

}  // namespace

GlfwWindow::GlfwWindow(int width, int height) {
  if (glfwInit() == GLFW_FALSE) no_window("GLFW did not start: " + last_glfw_error());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  window_ = glfwCreateWindow(width, height, "curveskel", nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = last_glfw_error();
    glfwTerminate();
    no_window("no window with OpenGL 3.3: " + why);
  }
  glfwMakeContextCurrent(window_);
  software_ = draws_in_software();
  glfwSwapInterval(software_ ? 0 : 1);
  keeps_ = software_ && keeps_what_is_drawn(window_);
  constexpr int least_width = 320;
  constexpr int least_height = 240;
  glfwSetWindowSizeLimits(window_, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window_, this);
  float scale_y = 1;
  glfwGetWindowContentScale(window_, &scale_, &scale_y);
  listen_to_all();
  start_imgui();
  listen_to_keys();
}

GlfwWindow::~GlfwWindow() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void GlfwWindow::show() { glfwShowWindow(window_); }

bool GlfwWindow::type() {
  for (const KeyEvent& event : typed_.take()) {
    if (event.letter != 0) {
      ImGui_ImplGlfw_CharCallback(window_, event.letter);
    } else {
      ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode,
                                 event.down ? GLFW_PRESS : GLFW_RELEASE, event.modifiers);
    }
  }
  return typed_.empty();
}

bool GlfwWindow::take_touched() { return std::exchange(touched_, false); }

bool GlfwWindow::take_kept() { return keeps_ && !std::exchange(spoilt_, false); }

void GlfwWindow::finish_frame() {
  if (software_) glfwSwapBuffers(window_);
  glFinish();
}

void GlfwWindow::renew_letters() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  spoilt_ = true;
}

void GlfwWindow::present() {
  if (!software_) glfwSwapBuffers(window_);
}

std::vector<std::filesystem::path> GlfwWindow::take_dropped() {
  return std::exchange(dropped_, {});
}

void GlfwWindow::start_imgui() const {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

/// Keys and letters in place of ImGui's own callbacks, which are called from `type`.
void GlfwWindow::listen_to_keys() {
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int with) {
    if (action == GLFW_REPEAT || key == GLFW_KEY_UNKNOWN) return;
    const bool modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
    const bool ends = key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_ESCAPE;
    GlfwWindow& self = owner_of(window);
    self.touched_ = true;
    const int meant = key_on_layout(key, glfwGetKeyName(key, code));
    self.typed_.add({meant, code, action == GLFW_PRESS, modifier, ends, with, 0});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned letter) {
    owner_of(window).typed_.add({0, 0, false, false, false, 0, letter});
  });
}

/// ImGui's callbacks, which come later, call these.
void GlfwWindow::listen_to_all() {
  glfwSetCursorPosCallback(window_,
                           [](GLFWwindow* w, double, double) { owner_of(w).touched_ = true; });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int) { owner_of(w).touched_ = true; });
  glfwSetMouseButtonCallback(window_,
                             [](GLFWwindow* w, int, int, int) { owner_of(w).touched_ = true; });
  glfwSetScrollCallback(window_,
                        [](GLFWwindow* w, double, double) { owner_of(w).touched_ = true; });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { owner_of(w).touched_ = true; });
  glfwSetWindowRefreshCallback(
      window_, [](GLFWwindow* w) { owner_of(w).touched_ = owner_of(w).spoilt_ = true; });
  glfwSetFramebufferSizeCallback(
      window_, [](GLFWwindow* w, int, int) { owner_of(w).touched_ = owner_of(w).spoilt_ = true; });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    owner_of(window).touched_ = true;
    owner_of(window).dropped_.assign(paths, paths + count);
  });
}

}  // namespace curveskel::viewer
