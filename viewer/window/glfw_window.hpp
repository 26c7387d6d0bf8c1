// The window itself: GLFW, OpenGL 3.3 and Dear ImGui in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/window/key_queue.hpp"

struct GLFWwindow;

namespace curveskel::viewer {

/// One window with a current OpenGL context, and ImGui in it, which has no fonts yet.
class GlfwWindow {
 public:
  /// Throws Error(Fault::device) where there is no display or no OpenGL 3.3.
  /// Not to be seen before `show`.
  GlfwWindow(int width, int height);
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;
  ~GlfwWindow();

  [[nodiscard]] GLFWwindow* get() const { return window_; }
  void show();
  /// Of letters, by the display.
  [[nodiscard]] float scale() const { return scale_; }
  /// Before a frame: hands ImGui the typed keys, as many as one frame can take. False if
  /// there is more.
  bool type();
  /// True if the window had any event (keys, mouse, size, files) since the last call.
  [[nodiscard]] bool take_touched();
  /// True if the last frame's picture is still there, so that a part of it can be drawn
  /// again alone: without a graphics card, where nothing was hidden or resized meanwhile.
  [[nodiscard]] bool take_kept();
  /// Waits until all that was drawn is there.
  void finish_frame();
  /// Between frames: ImGui's fonts are others.
  void renew_letters();
  /// Shows the frame. With a graphics card this waits for the screen.
  void present();
  /// Files that were dropped on it since the last call.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped();

 private:
  void start_imgui() const;
  void listen_to_all();
  void listen_to_keys();

  GLFWwindow* window_ = nullptr;
  float scale_ = 1;
  bool software_ = false;  // draws without a graphics card
  bool keeps_ = false;     // the drawn picture
  bool spoilt_ = true;     // it has to be drawn again
  bool touched_ = true;
  KeyQueue typed_;
  std::vector<std::filesystem::path> dropped_;
};

}  // namespace curveskel::viewer
