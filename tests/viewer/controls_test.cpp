// Laws of mouse and keys over the picture, frame by frame, without a window.
#include "viewer/window/controls.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/viewer/imgui_context.hpp"
#include "tests/viewer/waiting.hpp"

namespace curveskel::viewer::controls_laws {
namespace {

class Controlled : public testing::Test {
 protected:
  Controlled() {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;  // as the window does
    io.KeyMap[ImGuiKey_Space] = GLFW_KEY_SPACE;
    frame();
  }
  void frame(const std::function<void()>& panels_of_test = [] {}) {
    ImGui::NewFrame();
    controls.update(bench, panels, picture);
    panels_of_test();
    controls.end_frame();
    ImGui::Render();
  }
  void type(
      int key, bool with_ctrl = false, const std::function<void()>& panels_of_test = [] {}) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = with_ctrl;
    io.KeysDown[key] = true;
    frame(panels_of_test);
    io.KeysDown[key] = false;
    io.KeyCtrl = false;
    frame(panels_of_test);
  }
  /// Lets the camera arrive.
  Camera arrived() {
    while (controls.flying()) frame();
    return bench.scene->camera;
  }
  void open_y(bool run) {
    ViewOptions options;
    options.run = run;
    bench.open({mesh_called("y.off")});
    ASSERT_TRUE(wait_for(bench, [&] { return bench.scene->document.has_surface(); }));
  }

  ImGuiContextWithoutWindow context{800, 600};
  Workbench bench{[] {
    ViewOptions options;
    options.run = false;
    return options;
  }()};
  Panels panels;
  Controls controls;
  Area picture{0, 0, 800, 600};
};

TEST_F(Controlled, AClickRightAfterAMovementDoesNotTurnTheView) {
  open_y(false);
  frame();
  const Camera before = bench.scene->camera;
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {10, 10};
  frame();
  io.MousePos = {200, 150};  // in the frame in which the button goes down
  io.MouseDown[0] = true;
  frame();
  frame();
  io.MouseDown[0] = false;
  frame();
  EXPECT_EQ(bench.scene->camera.orientation, before.orientation);
  EXPECT_EQ(bench.scene->camera.target, before.target);
}

TEST_F(Controlled, ADragTurnsTheView) {
  open_y(false);
  frame();
  const Camera before = bench.scene->camera;
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {10, 10};
  frame();
  io.MouseDown[0] = true;
  frame();
  io.MousePos = {200, 150};
  frame();
  EXPECT_NE(bench.scene->camera.orientation, before.orientation);
}

TEST_F(Controlled, EscapeInAFieldOrListIsForThatAlone) {
  open_y(false);
  const auto field = [text = std::string("abc")]() mutable {
    ImGui::Begin("panel");
    ImGui::SetKeyboardFocusHere();
    char buffer[8] = "abc";
    ImGui::InputText("field", buffer, sizeof buffer);
    ImGui::End();
  };
  const auto list = [] {
    ImGui::Begin("panel");
    ImGui::OpenPopup("list");
    if (ImGui::BeginPopup("list")) ImGui::EndPopup();
    ImGui::End();
  };
  for (const std::function<void()>& shown : {std::function<void()>(field), {list}}) {
    panels.help = true;
    for (int settles = 0; settles < 3; ++settles) frame(shown);
    type(GLFW_KEY_ESCAPE, false, shown);
    EXPECT_TRUE(panels.help);
    for (int settles = 0; settles < 3; ++settles) frame();
    ImGui::GetIO().MouseDown[0] = true;  // beside it, which closes a list
    ImGui::GetIO().MousePos = {700, 500};
    frame();
    ImGui::GetIO().MouseDown[0] = false;
    frame();
    frame();
  }
  type(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(panels.help);
}

TEST_F(Controlled, EscapeClearsWhatIsChosenAndWhatIsRed) {
  open_y(false);
  bench.show_faces({0, 1});
  EXPECT_FALSE(bench.scene->highlights.failed_faces.empty());
  type(GLFW_KEY_ESCAPE);
  EXPECT_TRUE(bench.scene->highlights.failed_faces.empty());
}

TEST_F(Controlled, NoKeyLeavesWhileAFieldIsEdited) {
  const auto field = [] {
    ImGui::Begin("panel");
    ImGui::SetKeyboardFocusHere();
    char buffer[8] = "abc";
    ImGui::InputText("field", buffer, sizeof buffer);
    ImGui::End();
  };
  for (int settles = 0; settles < 3; ++settles) frame(field);
  type(GLFW_KEY_Q, true, field);
  EXPECT_FALSE(controls.wants_to_leave);
  for (int settles = 0; settles < 3; ++settles) frame();
  type(GLFW_KEY_Q, true);
  EXPECT_TRUE(controls.wants_to_leave);
}

TEST_F(Controlled, EachSideHasAKeyAndTheOtherSideTheSameWithCtrl) {
  open_y(false);
  const std::vector<std::pair<int, int>> keys{{GLFW_KEY_1, GLFW_KEY_KP_1},
                                              {GLFW_KEY_3, GLFW_KEY_KP_3},
                                              {GLFW_KEY_7, GLFW_KEY_KP_7},
                                              {GLFW_KEY_9, GLFW_KEY_KP_9}};
  for (const auto& [digit, pad] : keys) {
    for (const int key : {digit, pad}) {
      SCOPED_TRACE(key);
      type(GLFW_KEY_0);
      arrived();
      type(key);
      const glm::vec3 seen_from = arrived().axis(2);
      type(key, true);
      const glm::vec3 other_side = arrived().axis(2);
      EXPECT_LT(glm::dot(seen_from, other_side), -0.99F);
    }
  }
}

TEST_F(Controlled, EachStepFromTheInputMakesOneMoment) {
  open_y(false);
  for (std::size_t moments = 2; moments < 5; ++moments) {
    type(GLFW_KEY_RIGHT);
    ASSERT_TRUE(wait_for(bench, [&] { return bench.run_state() == Run::State::paused; }));
    EXPECT_EQ(bench.scene->recording.moments().size(), moments);
  }
}

}  // namespace
}  // namespace curveskel::viewer::controls_laws
