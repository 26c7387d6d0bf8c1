#include "viewer/window/window.hpp"

#include <epoxy/gl.h>
// OpenGL's functions are epoxy's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include "app/command_line.hpp"
#include "viewer/headless/screenshot.hpp"
#include "viewer/software/panel_changes.hpp"
#include "viewer/window/controls.hpp"
#include "viewer/window/glfw_window.hpp"
#include "viewer/window/letters.hpp"
#include "viewer/window/panels.hpp"
#include "viewer/window/reading_order.hpp"
#include "viewer/window/recent_files.hpp"
#include "viewer/window/window_picture.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

class Viewer {
 public:
  Viewer(const ViewOptions& options, Session& session)
      : options_(options),
        session_(session),
        window_(options.width, options.height),
        letters_(line_pixels * window_.scale()),
        bench_(options) {
    window_.show();
    panels_.gl = gl_name();
    panels_.may_be_coarse = options.may_be_coarse;
    panels_.transfer = "positions copied to OpenGL";
    bench_.scene->camera.orthographic = !options.perspective;
    const std::vector<fs::path> recent = recent_files();
    if (options.files.empty() && !recent.empty()) {
      panels_.browser.go_to(recent.front().parent_path());
    }
  }

  int show() {
    while (!leaves()) {
      wait_for_events();
      (void)attempt([&] {
        take_files();
        if (bench_.update()) awake();
      });
      // Keys typed while a dialogue opens are for the dialogue.
      if (panels_.browser.opening() || !window_.type()) awake();
      if (!wants_frame()) continue;
      if (frames_to_come_ > 0) --frames_to_come_;
      last_frame_ = Clock::now();
      draw_frame();
      set_title();
    }
    if (!options_.frame_times.empty()) write_file(options_.frame_times, panels_.times.text());
    session_.interruption.check();
    return ExitCode::done;
  }

 private:
  /// Whoever closes the window is asked first if something would be lost.
  [[nodiscard]] bool leaves() {
    if (session_.interruption.token().stop_requested() || panels_.may_leave) return true;
    if (glfwWindowShouldClose(window_.get()) == GLFW_FALSE && !controls_.wants_to_leave &&
        !bench_.wants_to_leave) {
      return false;
    }
    if (!bench_.would_lose()) return true;
    glfwSetWindowShouldClose(window_.get(), GLFW_FALSE);
    controls_.wants_to_leave = bench_.wants_to_leave = false;
    bench_.wants_to_abandon.emplace();
    awake();
    return false;
  }

  /// An action that fails says why; the window stays, and with it all corrections. False if so.
  template <typename Action>
  [[nodiscard]] bool attempt(const Action& action) {
    try {
      action();
      return true;
    } catch (const std::bad_alloc&) {
      bench_.say("out of memory; save what is of worth, and close other programs", true);
    } catch (const std::exception& problem) {
      bench_.say(problem.what(), true);
    }
    return false;
  }

  void awake() { frames_to_come_ = 3; }  // ImGui takes a few to settle

  /// Sleeps until something happens; at most sixty times a second where something moves.
  void wait_for_events() {
    constexpr double picture_seconds = 1.0 / 60;
    constexpr double idle_seconds = 0.25;
    const bool moving = bench_.busy() || letters_.looking() || controls_.flying() ||
                        frames_to_come_ > 0 || picture_.unrefined();
    const double left = picture_seconds - seconds_since(last_wait_);
    glfwWaitEventsTimeout(moving ? std::max(left, 1e-4) : idle_seconds);
    last_wait_ = Clock::now();
    if (window_.take_touched()) awake();
  }

  /// A run that only goes on shows its progress now and then, and has the cores for itself.
  [[nodiscard]] bool wants_frame() const {
    constexpr double progress_seconds = 0.1;
    constexpr double idle_seconds = 0.24;  // messages fade, cursors blink
    const bool refines = picture_.unrefined() && !picture_.moving();
    return frames_to_come_ > 0 || controls_.flying() || refines ||
           seconds_since(last_frame_) >
               (bench_.busy() || letters_.looking() ? progress_seconds : idle_seconds);
  }

  void take_files() {
    const std::vector<fs::path> dropped = window_.take_dropped();
    if (!dropped.empty()) bench_.open(dropped);
    constexpr double look_seconds = 0.5;
    if (seconds_since(files_seen_) > look_seconds) {
      files_seen_ = Clock::now();
      bench_.watch_files();
    }
    if (bench_.files() == remembered_) return;
    remembered_ = bench_.files();
    for (const fs::path& file : remembered_) remember_file(file);
    std::error_code error;
    if (!remembered_.empty()) {
      panels_.browser.go_to(fs::absolute(remembered_.front(), error).parent_path());
    }
  }

  /// The open files, the shown moment, and a flag for more to come.
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
    if (width == 0 || height == 0) return;  // minimised
    const Clock::time_point began = Clock::now();
    renew_letters();
    const Layout layout = lay_out_frame();
    const float ratio = ImGui::GetIO().DisplayFramebufferScale.x;
    const auto pixels = [ratio](float length) { return static_cast<int>(length * ratio); };
    const Area& area = layout.picture;
    const double picture_seconds = draw_picture(pixels(area.width), pixels(area.height));
    std::vector<Area> changed = changes_.since_last(*ImGui::GetDrawData());
    if (picture_seconds > 0) changed.push_back(whole_pixels(area));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!window_.take_kept()) {
      changed = {{0, 0, static_cast<float>(width) / ratio, static_cast<float>(height) / ratio}};
      glClearColor(0.5F, 0.5F, 0.5F, 1);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    if (changed.empty()) return;
    for (const Area& part : changed) {
      glEnable(GL_SCISSOR_TEST);
      glScissor(pixels(part.x), height - pixels(part.y + part.height), pixels(part.width),
                pixels(part.height));
      picture_.show(pixels(area.x), height - pixels(area.y) - pixels(area.height));
      glDisable(GL_SCISSOR_TEST);
      draw_within(*ImGui::GetDrawData(), part);
    }
    window_.finish_frame();
    const double seconds = seconds_since(began);
    window_.present();
    picture_.add_rest(1000 * (seconds - picture_seconds));
    if (picture_seconds > 0) panels_.times.add(1000 * seconds);
  }

  /// Those of the texts that the frame will show.
  void renew_letters() {
    for_each_name(bench_, panels_, [&](const std::string& name) {
      letters_.want(name);
      letters_.want(in_reading_order(name));
    });
    if (letters_.update()) window_.renew_letters();
    const std::string lacking = letters_.take_lacking();
    if (!lacking.empty()) bench_.say(lacking);
  }

  /// Actions of panels and keys are done at once.
  Layout lay_out_frame() {
    if (!styled_ || *styled_ != bench_.scene->look.theme) {
      styled_ = bench_.scene->look.theme;
      style_panels(*styled_, window_.scale());
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Layout layout = lay_out(size.x, size.y, window_.scale(), panels_.shown);
    panels_.scale = window_.scale();
    const bool done = attempt([&] {
      controls_.update(bench_, panels_, layout.picture);
      panels_.coarse = picture_.coarse();
      draw_panels(bench_, panels_, layout);
      controls_.end_frame();
      if (panels_.wants_picture) save_picture();
    });
    if (!done) ImGui::ErrorCheckEndFrameRecover(nullptr);  // ends what was begun
    ImGui::Render();
    return layout;
  }

  /// The seconds that it took; 0 if it is as it was.
  double draw_picture(int width, int height) {
    if (width < 1 || height < 1) return 0;
    const Clock::time_point began = Clock::now();
    picture_.may_be_coarse = panels_.may_be_coarse;
    bool drawn = false;
    if (!attempt([&] { drawn = picture_.draw(*bench_.scene, width, height); })) {
      picture_.forget();
      bench_.scene->forget_uploads();
    }
    return drawn ? seconds_since(began) : 0;
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
      write_file(file, screenshot(*bench_.scene, picture_.renderer(), picture_.width(),
                                  picture_.height()));
      bench_.say("saved " + file.string());
    } catch (const std::exception& problem) {
      bench_.say(problem.what(), true);
    }
    picture_.forget();
  }

  const ViewOptions& options_;
  Session& session_;
  static constexpr float line_pixels = 14;
  GlfwWindow window_;
  Letters letters_;
  Workbench bench_;  // opens the files meanwhile
  WindowPicture picture_;
  Panels panels_;
  PanelChanges changes_;
  Controls controls_;
  int frames_to_come_ = 3;
  Clock::time_point last_wait_ = Clock::now();
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
