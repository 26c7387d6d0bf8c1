// Laws of the panels, frame by frame, without a window.
#include "viewer/window/panels.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/own_folder.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "tests/viewer/imgui_context.hpp"
#include "tests/viewer/waiting.hpp"
#include "viewer/window/panel_parts.hpp"

namespace curveskel::viewer::panels_laws {
namespace {

constexpr float width = 1200;
constexpr float height = 1000;

class OnScreen : public testing::Test {
 protected:
  void frame(const std::function<void()>& content) {
    ImGui::NewFrame();
    content();
    ImGui::Render();
  }
  void frame() {
    frame([&] { draw_panels(bench, panels, lay_out(width, height, 1, true)); });
  }
  void click(float x, float y) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {x, y};
    frame();
    for (const bool down : {true, false}) {
      io.MouseDown[0] = down;
      frame();
    }
    io.MousePos = {-1, -1};
    for (int settles = 0; settles < 30; ++settles) frame();  // no double click
  }
  void open_rig() {
    write_rigged_bar(folder.path() / "bar.gltf", {.joints = 5, .first_weight = 0});
    bench.open({folder.path() / "bar.gltf"});
    ASSERT_TRUE(wait_for(bench, [&] { return bench.scene->document.rig != nullptr; }));
    for (int settles = 0; settles < 3; ++settles) frame();
  }

  ImGuiContextWithoutWindow context{width, height};
  Workbench bench{ViewOptions{}};
  Panels panels;
  OwnFolder folder;
};

TEST_F(OnScreen, AClickOnAJointInTheListMovesNoLine) {
  open_rig();
  const float x = width - 40;
  constexpr float line = 6;
  std::vector<int> found;
  for (float y = height - 40; y > 0; y -= line) {
    bench.select_joint(-1);
    frame();
    click(x, y);
    const int joint = bench.selected_joint();
    if (joint < 0) continue;
    click(x, y);
    EXPECT_EQ(bench.selected_joint(), -1) << "the same place is no longer joint " << joint;
    if (found.empty() || found.back() != joint) found.push_back(joint);
    if (joint == 0) break;  // headers come next
  }
  EXPECT_EQ(found, (std::vector<int>{4, 3, 2, 1, 0}));
}

TEST_F(OnScreen, AnEmptyWindowSaysHowToFillIt) {
  const auto words = [&] {
    frame();
    return ImGui::GetBackgroundDrawList()->VtxBuffer.size();
  };
  EXPECT_GT(words(), 0);
  open_rig();
  EXPECT_EQ(words(), 0);
}

TEST_F(OnScreen, ButtonsStandBesideEachOtherWhereTheyFit) {
  for (const float wide : {60.0F, 130.0F, 200.0F, 400.0F}) {
    std::vector<ImVec2> ends;
    std::vector<float> tops;
    float right = 0;
    const auto draw = [&] {
      ends.clear();
      tops.clear();
      ImGui::SetNextWindowSize({wide, 300});
      ImGui::Begin("row");
      right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
      for (const char* label : {"Prune", "Remove", "Merge", "Cut"}) {
        if (!ends.empty()) beside_if_it_fits(label);
        ImGui::Button(label);
        ends.push_back(ImGui::GetItemRectMax());
        tops.push_back(ImGui::GetItemRectMin().y);
      }
      ImGui::End();
    };
    for (int settles = 0; settles < 2; ++settles) frame(draw);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const bool is_beside = tops[i] == tops[i - 1];
      EXPECT_TRUE(!is_beside || ends[i].x <= right) << wide;
    }
    EXPECT_TRUE(wide < 400 || tops.back() == tops.front()) << wide;
  }
}

// Beyond 90 degrees about y, all three sprang to other angles of the same turn.
TEST_F(OnScreen, AnglesStayAsTheyWereSet) {
  open_rig();
  TurnAngles kept;
  const std::array<float, 3> none{};
  for (const std::array<float, 3>& wished :
       {std::array<float, 3>{10, 0, 0}, {170, 89, -20}, {-120, 90, 33}, {180, -90, 180}}) {
    set_angles(kept, bench, 1, wished);
    frame();
    EXPECT_EQ(angles_of(kept, bench, 1), wished);
    const Eigen::Quaterniond turn = (*bench.scene->turns())[1];
    std::array<double, 3> degrees{};
    std::transform(wished.begin(), wished.end(), degrees.begin(),
                   [](float angle) { return static_cast<double>(angle); });
    const Eigen::Quaterniond expected = turn_by(degrees);
    EXPECT_NEAR(std::abs(turn.dot(expected)), 1, 1e-9);
  }
  EXPECT_EQ(angles_of(kept, bench, 2), none);
  set_angles(kept, bench, 1, {10, 20, 30});
  bench.turn_joint(1, turn_by({0, 0, 5}));
  const std::array<float, 3> turned = angles_of(kept, bench, 1);
  EXPECT_NEAR(turned[0], 10, 1e-3);
  EXPECT_NEAR(turned[1], 20, 1e-3);
  EXPECT_NEAR(turned[2], 35, 1e-3);
  bench.turn_back();
  EXPECT_EQ(angles_of(kept, bench, 1), none);
}

// In a small window they hid all of the picture, and the timeline below it.
TEST_F(OnScreen, MessagesLeaveSomeOfThePictureToBeSeen) {
  constexpr float wide = 500;
  constexpr float high = 420;
  ImGui::GetIO().DisplaySize = {wide, high};
  const Layout layout = lay_out(wide, high, 1, true);
  const auto lowest = [&] {
    frame([&] { draw_panels(bench, panels, layout); });
    float found = 0;
    for (const ImDrawVert& corner : ImGui::GetForegroundDrawList()->VtxBuffer) {
      found = std::max(found, corner.pos.y);
    }
    return found;
  };
  EXPECT_EQ(lowest(), 0);
  for (int number = 0; number < 9; ++number) {
    bench.say("a message of some length, in several lines, number " + std::to_string(number));
    EXPECT_GT(lowest(), 0);
    EXPECT_LT(lowest(), 0.75F * layout.picture.height);
  }
}

// Below 500 units labels were cut.
TEST_F(OnScreen, NothingInAPanelIsWiderThanThePanel) {
  open_rig();
  bench.select_joint(1);
  bench.start(false);
  ASSERT_TRUE(wait_for(bench, [&] { return bench.judgement() != nullptr; }));
  for (const bool made : {false, true}) {
    if (made) {
      bench.rig();
      ASSERT_TRUE(wait_for(bench, [&] { return bench.has_rig(); }));
    }
    for (const auto& [wide, high] :
         {ImVec2{1200, 800}, {800, 600}, {640, 480}, {500, 420}, {400, 600}, {440, 300}}) {
      ImGui::GetIO().DisplaySize = {wide, high};
      const Layout layout = lay_out(wide, high, 1, true);
      for (int settles = 0; settles < 4; ++settles) {
        frame([&] { draw_panels(bench, panels, layout); });
      }
      for (const char* name : {"run", "look", "timeline"}) {
        const ImGuiWindow* const panel = ImGui::FindWindowByName(name);
        EXPECT_LE(panel->ContentSize.x, panel->WorkRect.GetWidth() + 1) << name << " at " << wide;
      }
    }
  }
}

// The second column was cut.
TEST_F(OnScreen, TheHelpIsNoWiderThanTheWindow) {
  panels.help = true;
  for (const ImVec2& size : {ImVec2{1200, 800}, {640, 480}, {400, 300}, {300, 200}}) {
    ImGui::GetIO().DisplaySize = size;
    for (int settles = 0; settles < 4; ++settles) {
      frame([&] { draw_panels(bench, panels, lay_out(size.x, size.y, 1, true)); });
    }
    const ImGuiWindow* const help = ImGui::FindWindowByName("Help");
    EXPECT_LE(help->Size.x, size.x);
    EXPECT_LE(help->ContentSize.x, help->WorkRect.GetWidth() + 1) << size.x;
  }
}

// The program ended so, with all corrections.
TEST_F(OnScreen, AWorkingDirectoryThatIsGoneIsNoEnd) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path gone = folder.path() / "gone";
  std::filesystem::create_directory(gone);
  std::filesystem::current_path(gone);
  std::filesystem::remove(gone);
  FileBrowser browser;
  EXPECT_NO_THROW(browser.ask(FileBrowser::Purpose::save, "Save the skeleton", "y.json"));
  EXPECT_NO_THROW(frame([&] { (void)browser.draw(); }));
  std::filesystem::current_path(before);
}

// The rest after "##" was left out.
TEST_F(OnScreen, TheFileWindowListsWholeNames) {
  const auto drawn = [&](const char* name) {
    const OwnFolder listed;
    (void)listed.write(name, "OFF\n");
    FileBrowser browser;
    browser.go_to(listed.path());
    browser.ask(FileBrowser::Purpose::open, "Open", "");
    for (int settles = 0; settles < 3; ++settles) frame([&] { (void)browser.draw(); });
    const auto& windows = ImGui::GetCurrentContext()->Windows;
    const auto* const files = std::find_if(
        windows.begin(), windows.end(),
        [](const ImGuiWindow* one) { return std::string(one->Name).starts_with("Open/files"); });
    const int corners = files == windows.end() ? 0 : (*files)->DrawList->VtxBuffer.size();
    browser.close();
    for (int settles = 0; settles < 3; ++settles) frame([&] { (void)browser.draw(); });
    return corners;
  };
  EXPECT_GT(drawn("a.off"), 0);
  EXPECT_GT(drawn("aaaab.off"), drawn("a.off"));
  EXPECT_EQ(drawn("a##ab.off"), drawn("aaaab.off"));
  EXPECT_EQ(drawn("##aab.off"), drawn("aaaab.off"));
}

TEST_F(OnScreen, TheFileWindowIsAsLargeAsItsLetters) {
  const auto size = [&](float scale) {
    ImGui::GetIO().FontGlobalScale = scale;
    FileBrowser browser;
    browser.ask(FileBrowser::Purpose::open, "Open a surface or a skeleton", "");
    for (int settles = 0; settles < 3; ++settles) frame([&] { (void)browser.draw(); });
    const ImVec2 found = ImGui::FindWindowByName("Open a surface or a skeleton")->SizeFull;
    browser.close();
    for (int settles = 0; settles < 3; ++settles) frame([&] { (void)browser.draw(); });
    return found;
  };
  const ImVec2 usual = size(0.75F);
  const ImVec2 twice = size(1.5F);
  EXPECT_NEAR(twice.x, 2 * usual.x, 2);
  EXPECT_NEAR(twice.y, 2 * usual.y, 2);
}

}  // namespace
}  // namespace curveskel::viewer::panels_laws
