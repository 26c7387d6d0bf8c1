#include "viewer/window.hpp"

#include <epoxy/gl.h>
// OpenGL's functions are epoxy's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line.hpp"
#include "surface/error.hpp"
#include "surface/write_file.hpp"
#include "viewer/controls.hpp"
#include "viewer/key_queue.hpp"
#include "viewer/panels.hpp"
#include "viewer/recent_files.hpp"
#include "viewer/renderer.hpp"
#include "viewer/screenshot.hpp"
#include "viewer/workbench.hpp"

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// GLFW, one window with a current OpenGL 3.3 context, and ImGui in it.
class GlfwWindow {
 public:
  GlfwWindow(int width, int height) {
    if (glfwInit() == GLFW_FALSE) no_window("GLFW did not start: " + last_error());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, "curveskel", nullptr, nullptr);
    if (window_ == nullptr) {
      const std::string why = last_error();
      glfwTerminate();
      no_window("no window with OpenGL 3.3: " + why);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    constexpr int least_width = 320;
    constexpr int least_height = 240;
    glfwSetWindowSizeLimits(window_, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
      auto* const self = static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
      self->dropped.assign(paths, paths + count);
    });
    float scale_y = 1;
    glfwGetWindowContentScale(window_, &scale_, &scale_y);
    start_imgui();
    listen_to_keys();
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;
  ~GlfwWindow() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  [[nodiscard]] GLFWwindow* get() const { return window_; }
  [[nodiscard]] float scale() const { return scale_; }
  /// Before a frame: hands ImGui what was typed, as much of it as one frame can take. False if
  /// there is more.
  bool type() {
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
  std::vector<fs::path> dropped;

 private:
  static std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "unknown" : text;
  }
  [[noreturn]] static void no_window(const std::string& why) {
    throw Error(Fault::device, why + "; without a display, use --screenshot or --turntable");
  }
  void start_imgui() const {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    constexpr float letters = 14;
    std::error_code error;
    for (const char* font : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"}) {
      if (fs::exists(font, error)) {
        ImGui::GetIO().Fonts->AddFontFromFileTTF(font, letters * scale_);
        return;
      }
    }
    ImGui::GetIO().FontGlobalScale = scale_;
  }

  /// In place of ImGui's own, which are called from `type`.
  void listen_to_keys() {
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int with) {
      if (action == GLFW_REPEAT || key == GLFW_KEY_UNKNOWN) return;
      const bool modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
      const bool ends =
          key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_ESCAPE;
      static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))
          ->typed_.add({key, code, action == GLFW_PRESS, modifier, ends, with, 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned letter) {
      static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))
          ->typed_.add({0, 0, false, false, false, 0, letter});
    });
  }

  GLFWwindow* window_ = nullptr;
  float scale_ = 1;
  KeyQueue typed_;
};

/// What the last picture showed; equal = it need not be drawn again.
struct Drawn {
  Camera camera;
  Look look;
  Highlights highlights;
  std::shared_ptr<const CurveSkeleton> skeleton;
  const Scene* scene = nullptr;
  std::size_t moment = 0;
  std::size_t moments = 0;
  int width = 0;
  int height = 0;
  Fineness fineness;

  [[nodiscard]] bool shows_same(const Drawn& other) const {
    const auto same_camera = [](const Camera& a, const Camera& b) {
      return a.target == b.target && a.orientation == b.orientation && a.distance == b.distance &&
             a.orthographic == b.orthographic && a.field_of_view == b.field_of_view;
    };
    return same_camera(camera, other.camera) && look == other.look &&
           highlights == other.highlights && skeleton == other.skeleton && scene == other.scene &&
           moment == other.moment && moments == other.moments && width == other.width &&
           height == other.height;
  }
};

class Viewer {
 public:
  Viewer(const ViewOptions& options, Session& session)
      : options_(options),
        session_(session),
        window_(options.width, options.height),
        bench_(options) {
    panels_.gl = gl_name();
    panels_.transfer = "positions copied to OpenGL";
    bench_.scene->camera.orthographic = !options.perspective;
    const std::vector<fs::path> recent = recent_files();
    if (options.files.empty() && !recent.empty()) {
      panels_.browser.go_to(recent.front().parent_path());
    }
  }

  int show() {
    while (glfwWindowShouldClose(window_.get()) == GLFW_FALSE && !controls_.wants_to_leave &&
           !session_.interruption.token().stop_requested()) {
      wait_for_events();
      const Clock::time_point began = Clock::now();
      take_files();
      if (bench_.update()) awake();
      // What is typed while a dialogue opens is for that.
      if (panels_.browser.opening() || !window_.type()) awake();
      draw_frame();
      glfwSwapBuffers(window_.get());
      set_title();
      const double milliseconds = 1000 * seconds_since(began);
      if (!drawn_anew_) continue;
      panels_.times.add(milliseconds);
      if (all_anew_) pace_.measured(drawn_.fineness, load_, milliseconds);
    }
    if (!options_.frame_times.empty()) write_file(options_.frame_times, panels_.times.text());
    session_.interruption.check();
    return ExitCode::done;
  }

 private:
  [[nodiscard]] bool moving() const {
    constexpr double rest_seconds = 0.3;
    return seconds_since(moved_) <= rest_seconds;
  }
  void awake() { frames_to_come_ = 3; }  // ImGui takes a few to settle

  /// Sleeps where nothing moves; at most sixty pictures a second where something does.
  void wait_for_events() {
    constexpr double picture_seconds = 1.0 / 60;
    constexpr double idle_seconds = 0.25;
    const bool moving = bench_.busy() || controls_.flying() || frames_to_come_ > 0 || unrefined_;
    const double pause =
        moving ? std::max(picture_seconds - seconds_since(last_frame_), 1e-4) : idle_seconds;
    const Clock::time_point before = Clock::now();
    glfwWaitEventsTimeout(pause);
    if (seconds_since(before) < pause * 0.95) awake();
    if (frames_to_come_ > 0) --frames_to_come_;
    last_frame_ = Clock::now();
  }

  void take_files() {
    if (!window_.dropped.empty()) {
      bench_.open(window_.dropped);
      window_.dropped.clear();
    }
    constexpr double look_seconds = 0.5;
    if (seconds_since(files_seen_) > look_seconds) {
      files_seen_ = Clock::now();
      bench_.watch_files();
    }
    if (bench_.files() == remembered_) return;
    remembered_ = bench_.files();
    for (const fs::path& file : remembered_) remember_file(file);
  }

  /// What is open, which moment of it is shown, and whether more is to come.
  void set_title() {
    std::string title = "curveskel";
    for (const fs::path& file : bench_.files()) title += " - " + file.filename().string();
    if (!bench_.files().empty()) {
      title += " (" + title_of(bench_.scene->recording.moments()[bench_.scene->moment]);
      if (bench_.running()) {
        title += bench_.run_state() == Run::State::paused ? ", paused" : ", running";
      }
      title += ")";
    }
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_.get(), title.c_str());
  }

  void draw_frame() {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    drawn_anew_ = false;
    if (width == 0 || height == 0) return;  // minimised
    if (!styled_ || *styled_ != bench_.scene->look.theme) {
      styled_ = bench_.scene->look.theme;
      style_panels(*styled_, window_.scale());
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const ImGuiIO& io = ImGui::GetIO();
    const Layout layout =
        lay_out(io.DisplaySize.x, io.DisplaySize.y, window_.scale(), panels_.shown);
    controls_.update(bench_, panels_, layout.picture);
    draw_panels(bench_, panels_, layout);
    if (panels_.wants_picture) save_picture();
    ImGui::Render();
    const float ratio = io.DisplayFramebufferScale.x;
    draw_scene({layout.picture.x * ratio, layout.picture.y * ratio, layout.picture.width * ratio,
                layout.picture.height * ratio},
               height);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  /// Coarser while things move, if the machine is slow; as fine as it bears once they rest.
  Fineness fineness_now(bool same) {
    constexpr double moving_milliseconds = 13;
    constexpr double resting_milliseconds = 400;
    if (!same) moved_ = Clock::now();
    const bool rests = !moving();
    const Fineness finest = pace_.choose(load_, resting_milliseconds);
    const Fineness now = rests ? finest : pace_.choose(load_, moving_milliseconds);
    unrefined_ = !(now == finest) || !rests;
    return now;
  }

  void draw_scene(const Area& area, int window_height) {
    const auto width = static_cast<int>(area.width);
    const auto height = static_cast<int>(area.height);
    if (width < 1 || height < 1) return;
    Scene& scene = *bench_.scene;
    if (drawn_.scene != &scene) scene.forget_uploads();
    Drawn now{scene.camera,
              scene.look_now(),
              scene.highlights,
              scene.skeleton(),
              &scene,
              scene.moment,
              scene.recording.moments().size(),
              width,
              height,
              {}};
    const bool same = now.shows_same(drawn_);
    load_ = {scene.sizes(), static_cast<double>(width) * height};
    now.fineness = fineness_now(same);
    const bool finer = now.fineness.level < drawn_.fineness.level ||
                       now.fineness.samples > drawn_.fineness.samples ||
                       now.fineness.shrink < drawn_.fineness.shrink;
    if (!same || (finer && !moving())) {
      scene.upload(renderer_);
      all_anew_ =
          renderer_.draw(scene.camera, now.look,
                         {std::max(width / now.fineness.shrink, 1),
                          std::max(height / now.fineness.shrink, 1), now.fineness, scene.bounds()});
      drawn_ = now;
      drawn_anew_ = true;
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glClearColor(0.5F, 0.5F, 0.5F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer_.picture().framebuffer());
    const auto left = static_cast<int>(area.x);
    const int bottom = window_height - static_cast<int>(area.y) - height;
    const GlTarget::Form& drawn = renderer_.picture().form();
    glBlitFramebuffer(0, 0, drawn.width, drawn.height, left, bottom, left + width, bottom + height,
                      GL_COLOR_BUFFER_BIT, drawn.width == width ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }

  void save_picture() {
    panels_.wants_picture = false;
    fs::path stem = bench_.files().empty() ? fs::path("curveskel") : bench_.files().front();
    stem.replace_extension();
    std::error_code error;
    fs::path file;
    for (int number = 1; file.empty() || fs::exists(file, error); ++number) {
      file = stem;
      file += "-view-" + std::to_string(number) + ".png";
    }
    try {
      write_file(file, screenshot(*bench_.scene, renderer_, drawn_.width, drawn_.height));
      bench_.say("saved " + file.string());
    } catch (const Error& problem) {
      bench_.say(problem.what(), true);
    }
    drawn_ = {};
  }

  const ViewOptions& options_;
  Session& session_;
  GlfwWindow window_;
  Renderer renderer_;
  Workbench bench_;
  Panels panels_;
  Controls controls_;
  Pace pace_;
  Pace::Load load_;
  Drawn drawn_;
  bool drawn_anew_ = false;
  bool all_anew_ = false;
  bool unrefined_ = false;
  int frames_to_come_ = 3;
  Clock::time_point moved_ = Clock::now();
  Clock::time_point last_frame_ = Clock::now();
  Clock::time_point files_seen_ = Clock::now();
  std::optional<Theme> styled_;
  std::vector<fs::path> remembered_;
  std::string title_;
};

}  // namespace

int run_window(const ViewOptions& options, Session& session) {
  return Viewer(options, session).show();
}

}  // namespace curveskel::viewer
