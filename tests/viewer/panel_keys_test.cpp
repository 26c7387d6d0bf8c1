// Laws of the keys for the panels, frame by frame, without a window.
#include "viewer/window/panel_keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/own_folder.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "tests/viewer/imgui_context.hpp"
#include "tests/viewer/waiting.hpp"
#include "viewer/window/controls.hpp"

namespace curveskel::viewer::panel_keys_laws {
namespace {

constexpr float width = 1200;
constexpr float height = 900;

class Typed : public testing::Test {
 protected:
  Typed() {
    ImGuiIO& io = ImGui::GetIO();
    // As the window does.
    for (const auto& [key, code] : {std::pair<int, int>{ImGuiKey_Tab, GLFW_KEY_TAB},
                                    {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                    {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                    {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                    {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                    {ImGuiKey_Home, GLFW_KEY_HOME},
                                    {ImGuiKey_End, GLFW_KEY_END},
                                    {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                    {ImGuiKey_Space, GLFW_KEY_SPACE},
                                    {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                    {ImGuiKey_Escape, GLFW_KEY_ESCAPE}}) {
      io.KeyMap[key] = code;
    }
    bench.open({mesh_called("y.off")});
    EXPECT_TRUE(wait_for(bench, [&] { return bench.result() != nullptr && !bench.busy(); }));
    settle();
  }
  void frame() {
    ImGui::NewFrame();
    const Layout layout = lay_out(width, height, 1, panels.shown);
    controls.update(bench, panels, layout.picture);
    draw_panels(bench, panels, layout);
    controls.end_frame();
    ImGui::Render();
  }
  void settle() {
    for (int frames = 0; frames < 4; ++frames) frame();
  }
  void type(int key, bool shift = false) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyShift = shift;
    io.KeysDown[key] = true;
    frame();
    io.KeysDown[key] = false;
    io.KeyShift = false;
    settle();
  }
  void correct_something() {
    Pick edge;
    edge.kind = Pick::Kind::edge;
    edge.index = 0;
    bench.select(edge, false);
    bench.split();
    ASSERT_TRUE(bench.history().unsaved());
    settle();
  }
  void click(const ImVec2& place) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = place;
    settle();
    for (const bool down : {true, false}) {
      io.MouseDown[0] = down;
      frame();
    }
    settle();
  }
  /// Of that to which keys have come.
  [[nodiscard]] static ImVec2 middle_of_control_in(const ImGuiWindow& window) {
    const ImVec2 middle = window.NavRectRel[0].GetCenter();
    const ImVec2 start = window.DC.CursorStartPos;
    return {start.x + middle.x, start.y + middle.y};
  }
  /// The middle of a control, to which Tab has come.
  [[nodiscard]] ImVec2 place_of(const char* panel_name, const char* label) {
    const ImGuiWindow* const window = ImGui::FindWindowByName(panel_name);
    const ImGuiID wanted = const_cast<ImGuiWindow*>(window)->GetID(label);
    for (int tabs = 0; tabs < 80 && at() != wanted; ++tabs) type(GLFW_KEY_TAB);
    EXPECT_EQ(at(), wanted) << label;
    return middle_of_control_in(*window);
  }
  static void point_at_the_model() { ImGui::GetIO().MousePos = {width / 2, height * 0.42F}; }
  [[nodiscard]] std::size_t moment() const { return bench.scene->moment; }
  [[nodiscard]] static ImGuiID at() { return ImGui::GetCurrentContext()->NavId; }
  [[nodiscard]] static std::string panel() {
    const ImGuiWindow* const window = ImGui::GetCurrentContext()->NavWindow;
    return window == nullptr ? "" : window->RootWindow->Name;
  }
  /// A frame stands round a control.
  [[nodiscard]] static bool are_for_panels() { return ImGui::GetIO().NavVisible; }

  ImGuiContextWithoutWindow context{width, height};
  Workbench bench{ViewOptions{}};
  Panels panels;
  Controls controls;
};

TEST_F(Typed, WithoutTabAllKeysAreForThePicture) {
  const std::size_t last = bench.scene->recording.moments().size() - 1;
  EXPECT_EQ(moment(), last);
  type(GLFW_KEY_LEFT);
  EXPECT_EQ(moment(), last - 1);
  type(GLFW_KEY_HOME);
  EXPECT_EQ(moment(), 0);
  type(GLFW_KEY_DOWN);
  type(GLFW_KEY_ENTER);
  EXPECT_FALSE(are_for_panels());
}

TEST_F(Typed, TabGoesThroughAllPanelsAndRound) {
  std::vector<std::string> visited;
  std::set<ImGuiID> controls_met;
  ImGuiID first = 0;
  constexpr int enough = 200;
  int pressed = 0;
  for (; pressed < enough; ++pressed) {
    type(GLFW_KEY_TAB);
    ASSERT_TRUE(are_for_panels());
    ASSERT_NE(at(), 0U);
    if (visited.empty() || visited.back() != panel()) visited.push_back(panel());
    if (first == 0) first = at();
    if (pressed > 0 && at() == first) break;
    controls_met.insert(at());
    EXPECT_EQ(ImGui::GetCurrentContext()->ActiveId, 0U) << "nothing is edited or pressed";
  }
  EXPECT_EQ(visited, (std::vector<std::string>{"run", "look", "timeline", "run"}));
  EXPECT_EQ(static_cast<int>(controls_met.size()), pressed) << "each once";
  EXPECT_GT(pressed, 40);
  type(GLFW_KEY_TAB, true);
  EXPECT_EQ(panel(), "timeline") << "and back";
}

TEST_F(Typed, ArrowsAndSpaceAreForThePanelsUntilEscape) {
  const std::size_t before = moment();
  type(GLFW_KEY_TAB);
  const ImGuiID first = at();
  type(GLFW_KEY_RIGHT);
  EXPECT_NE(at(), first);
  type(GLFW_KEY_LEFT);
  EXPECT_EQ(at(), first);
  EXPECT_EQ(moment(), before);
  type(GLFW_KEY_SPACE);  // on "Open"
  EXPECT_TRUE(panels.browser.shown());
  EXPECT_FALSE(bench.running());
  type(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(panels.browser.shown());
  if (are_for_panels()) type(GLFW_KEY_ESCAPE);
  type(GLFW_KEY_LEFT);
  EXPECT_EQ(moment(), before - 1);
  EXPECT_FALSE(are_for_panels());
}

TEST_F(Typed, EnterPressesAButtonAndTicksABox) {
  const auto go_to = [&](const char* panel_name, const char* label) {
    const ImGuiID wanted = ImGui::FindWindowByName(panel_name)->GetID(label);
    for (int tabs = 0; tabs < 80 && at() != wanted; ++tabs) type(GLFW_KEY_TAB);
    return at() == wanted;
  };
  ASSERT_TRUE(go_to("run", "Help"));
  type(GLFW_KEY_ENTER);
  EXPECT_TRUE(panels.help);
  type(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(panels.help);
  ASSERT_TRUE(go_to("look", "edges"));
  type(GLFW_KEY_ENTER);
  EXPECT_TRUE(bench.scene->look.edges);
}

TEST_F(Typed, AClickGivesTheKeysBackToThePicture) {
  const std::size_t before = moment();
  type(GLFW_KEY_TAB);
  ImGui::GetIO().MousePos = {width / 2, 60};
  frame();
  for (const bool down : {true, false}) {
    ImGui::GetIO().MouseDown[0] = down;
    frame();
  }
  type(GLFW_KEY_LEFT);
  EXPECT_EQ(moment(), before - 1);
  EXPECT_FALSE(are_for_panels());
}

TEST_F(Typed, LettersStayShortcutsWithinThePanels) {
  type(GLFW_KEY_TAB);
  type(GLFW_KEY_E);
  EXPECT_TRUE(bench.scene->look.edges);
  type(GLFW_KEY_P);
  EXPECT_FALSE(panels.shown);
  type(GLFW_KEY_TAB);
  EXPECT_TRUE(panels.shown) << "Tab brings them back";
  EXPECT_TRUE(are_for_panels());
}

TEST_F(Typed, ASliderIsChangedByArrowsAndANumberIsTyped) {
  const auto go_to_detail = [&] {
    const ImGuiWindow* const run = ImGui::FindWindowByName("run");
    const ImGuiID detail = const_cast<ImGuiWindow*>(run)->GetID("detail");
    for (int tabs = 0; tabs < 40 && at() != detail; ++tabs) type(GLFW_KEY_TAB);
    return at() == detail;
  };
  ASSERT_TRUE(go_to_detail());
  const double before = bench.pipeline.extract.embed.detail;
  type(GLFW_KEY_SPACE);
  type(GLFW_KEY_LEFT);
  EXPECT_LT(bench.pipeline.extract.embed.detail, before);
  type(GLFW_KEY_ESCAPE);
  EXPECT_EQ(ImGui::GetCurrentContext()->ActiveId, 0U);
  EXPECT_TRUE(are_for_panels()) << "the slider was left, not the panels";
  type(GLFW_KEY_ENTER);
  EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "a number can be typed";
}

TEST_F(Typed, AJointIsChosenInTheListBySpaceAndByEnter) {
  const OwnFolder folder;
  write_rigged_bar(folder.path() / "bar.gltf", {.joints = 5, .first_weight = 0});
  bench.open({folder.path() / "bar.gltf"});
  ASSERT_TRUE(wait_for(bench, [&] { return bench.scene->document.rig != nullptr; }));
  settle();
  const auto is_in_list = [] {
    const ImGuiWindow* const window = ImGui::GetCurrentContext()->NavWindow;
    return window != nullptr && std::string(window->Name).find("joints") != std::string::npos;
  };
  for (int tabs = 0; tabs < 60 && !is_in_list(); ++tabs) type(GLFW_KEY_TAB);
  ASSERT_TRUE(is_in_list());
  type(GLFW_KEY_SPACE);
  EXPECT_EQ(bench.selected_joint(), 0);
  type(GLFW_KEY_DOWN);
  type(GLFW_KEY_ENTER);
  EXPECT_EQ(bench.selected_joint(), 1);
  type(GLFW_KEY_ENTER);
  EXPECT_EQ(bench.selected_joint(), -1);
}

// The program ended so, with all corrections.
TEST_F(Typed, ADialogueMayOpenByAKeyWhileThePointerRestsOnTheModel) {
  correct_something();
  point_at_the_model();
  bench.wants_to_abandon.emplace();  // as Ctrl-Q does
  settle();
  type(GLFW_KEY_S);
  EXPECT_TRUE(panels.browser.shown());
  EXPECT_FALSE(bench.wants_to_abandon);
}

TEST_F(Typed, ADialogueMayOpenInTheFrameInWhichThePointerComesToTheModel) {
  correct_something();
  for (const auto& ask : {std::function<void()>([&] { ask_to_open(panels); }),
                          {[&] { bench.wants_to_abandon.emplace(); }},
                          {[&] { bench.wants_to_replace = "y.json"; }}}) {
    ImGui::GetIO().MousePos = {-1, -1};
    settle();
    point_at_the_model();
    ask();
    settle();
    EXPECT_TRUE(is_list_open());
    type(GLFW_KEY_ESCAPE);
    settle();
    EXPECT_FALSE(is_list_open());
  }
}

TEST_F(Typed, SaveInTheQuestionGoesOnOnceItIsSaved) {
  const OwnFolder folder;
  for (const std::vector<std::filesystem::path>& next :
       {std::vector<std::filesystem::path>{}, {mesh_called("torus.off")}}) {
    correct_something();
    panels.browser.go_to(folder.path());
    const auto answer = [&](int key) {
      bench.wants_to_abandon = next;
      settle();
      type(GLFW_KEY_S);
      type(key);
      EXPECT_FALSE(panels.browser.shown());
    };
    answer(GLFW_KEY_ESCAPE);  // no file is named
    bench.save(folder.path() / "picture.png", true);
    EXPECT_FALSE(bench.wants_to_leave || bench.opening());
    const auto saved = folder.path() / "y.json";
    answer(GLFW_KEY_ENTER);
    EXPECT_TRUE(std::filesystem::remove(saved));
    EXPECT_EQ(std::exchange(bench.wants_to_leave, false), next.empty());
    EXPECT_EQ(bench.opening(), !next.empty());
  }
}

// The dialogue stayed, unseen, and had all keys.
TEST_F(Typed, AQuestionEndsTheDialogueThatItComesOver) {
  correct_something();
  ask_to_open(panels);
  settle();
  bench.wants_to_abandon.emplace();  // as the window's close button does
  settle();
  EXPECT_FALSE(panels.browser.shown());
  type(GLFW_KEY_ESCAPE);
  const std::size_t before = moment();
  type(GLFW_KEY_LEFT);
  EXPECT_EQ(moment(), before - 1);
}

// Ctrl-Q ended the program without a word, and there was no file.
TEST_F(Typed, LeavingAsksWhileARigIsMadeForASave) {
  const OwnFolder folder;
  for (const auto& [key, leaves] : {std::pair{GLFW_KEY_W, true}, {GLFW_KEY_ESCAPE, false}}) {
    bench.undo();
    correct_something();  // so that there is no rig
    const auto file = folder.path() / (leaves ? "left.glb" : "stayed.glb");
    bench.save(file);
    ASSERT_TRUE(bench.would_lose());
    bench.wants_to_abandon.emplace();
    settle();
    EXPECT_TRUE(is_list_open());
    type(key);
    EXPECT_FALSE(is_list_open());
    ASSERT_TRUE(wait_for(bench, [&] { return !bench.busy(); }));
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(std::exchange(bench.wants_to_leave, false), leaves);
  }
}

TEST_F(Typed, AQuestionIsAnsweredByArrowsAndEnter) {
  correct_something();
  bench.wants_to_abandon.emplace();
  settle();
  const auto is_at = [](const char* label) {
    return at() == ImGui::FindWindowByName("Discard corrections?")->GetID(label);
  };
  EXPECT_TRUE(are_for_panels()) << "a frame stands round it";
  EXPECT_TRUE(is_at("Stay"));
  type(GLFW_KEY_LEFT);
  EXPECT_TRUE(is_at("Discard"));
  type(GLFW_KEY_RIGHT);
  type(GLFW_KEY_ENTER);
  EXPECT_FALSE(bench.wants_to_abandon);
  EXPECT_FALSE(panels.may_leave);
  EXPECT_FALSE(are_for_panels());
  bench.wants_to_abandon.emplace();
  settle();
  type(GLFW_KEY_LEFT);
  type(GLFW_KEY_ENTER);
  EXPECT_TRUE(panels.may_leave);
}

TEST_F(Typed, AKeyThatWentDownBeforeAQuestionIsNoAnswer) {
  correct_something();
  for (const int key : {GLFW_KEY_ENTER, GLFW_KEY_SPACE}) {
    ImGui::GetIO().KeysDown[key] = true;
    frame();
    bench.wants_to_abandon.emplace();
    settle();
    EXPECT_TRUE(bench.wants_to_abandon);
    ImGui::GetIO().KeysDown[key] = false;
    settle();
    EXPECT_TRUE(bench.wants_to_abandon);
    type(key);
    EXPECT_FALSE(bench.wants_to_abandon);
  }
}

TEST_F(Typed, AQuestionIsAnsweredByTheMouse) {
  correct_something();
  bench.wants_to_abandon.emplace();
  settle();
  click(middle_of_control_in(*ImGui::FindWindowByName("Discard corrections?")));
  EXPECT_FALSE(bench.wants_to_abandon);
  EXPECT_FALSE(is_list_open());
}

TEST_F(Typed, AListThatTheMouseOpenedIsUsedByArrowsAndEnter) {
  for (const bool by_tab : {false, true}) {
    const ImVec2 list = place_of("look", "surface");
    const SurfaceStyle before = bench.scene->look.surface;
    const std::size_t shown = moment();
    if (!by_tab) type(GLFW_KEY_ESCAPE);
    EXPECT_EQ(are_for_panels(), by_tab);
    click(list);
    ASSERT_TRUE(is_list_open());
    type(GLFW_KEY_DOWN);
    type(GLFW_KEY_ENTER);
    EXPECT_FALSE(is_list_open());
    EXPECT_NE(bench.scene->look.surface, before);
    type(GLFW_KEY_HOME);
    EXPECT_EQ(moment(), 0) << "keys are for the picture again";
    bench.go_to(shown);
    settle();
  }
}

TEST_F(Typed, AClickInThePictureClosesAListAndCounts) {
  const ImVec2 list = place_of("look", "surface");
  type(GLFW_KEY_ESCAPE);
  click(list);
  ASSERT_TRUE(is_list_open());
  bench.clear_selection();
  point_at_the_model();
  click(ImGui::GetIO().MousePos);
  EXPECT_FALSE(is_list_open());
  EXPECT_TRUE(bench.selected_edge() >= 0 || !bench.selected_nodes().empty());
}

TEST_F(Typed, ArrowsInTheDialogueNameFilesOneAfterTheOther) {
  const OwnFolder folder;
  for (const char* name : {"a.off", "b.off", "c.off"}) (void)folder.write(name, "OFF\n");
  panels.browser.go_to(folder.path());
  ask_to_open(panels);
  settle();
  std::vector<std::string> named;
  for (const int key : {GLFW_KEY_DOWN, GLFW_KEY_DOWN, GLFW_KEY_DOWN, GLFW_KEY_DOWN, GLFW_KEY_UP}) {
    type(key);
    named.push_back(panels.browser.name());
  }
  EXPECT_EQ(named, (std::vector<std::string>{"a.off", "b.off", "c.off", "c.off", "b.off"}));
  type(GLFW_KEY_ENTER);
  EXPECT_FALSE(panels.browser.shown());
  EXPECT_EQ(bench.messages().back().text, "opening b.off");
}

// The name had a NUL in it, so that nothing was saved.
TEST_F(Typed, ANameWithAnEmojiIsSavedAsItIsAndEdited) {
  const OwnFolder folder;
  const std::string fox = "\U0001F98A";
  const auto inner = folder.path() / fox;
  std::filesystem::create_directory(inner);
  panels.browser.go_to(inner);
  panels.browser.ask(FileBrowser::Purpose::save, "Save the skeleton", fox + ".json");
  settle();
  type(GLFW_KEY_ENTER);
  EXPECT_FALSE(panels.browser.shown()) << panels.browser.name();
  EXPECT_TRUE(std::filesystem::exists(inner / (fox + ".json"))) << bench.messages().back().text;
  panels.browser.ask(FileBrowser::Purpose::save, "Save the skeleton", fox + ".json");
  settle();
  type(GLFW_KEY_END);
  for (int letters = 0; letters < 4; ++letters) type(GLFW_KEY_BACKSPACE);
  ImGui::GetIO().AddInputCharactersUTF8((fox + "ply").c_str());  // no field can hold the first
  settle();
  EXPECT_EQ(panels.browser.name(), fox + ".ply");
  type(GLFW_KEY_ENTER);
  EXPECT_TRUE(std::filesystem::exists(inner / (fox + ".ply"))) << bench.messages().back().text;
}

TEST_F(Typed, AVrmFileIsNotChosenBeforeItsTextsAreThere) {
  const OwnFolder folder;
  panels.browser.go_to(folder.path());
  const auto chosen_by_enter = [&](const char* name) {
    panels.browser.ask(FileBrowser::Purpose::save, "Save the rig", name);
    settle();
    type(GLFW_KEY_ENTER);
    return !panels.browser.shown();
  };
  EXPECT_FALSE(chosen_by_enter("y.vrm"));
  EXPECT_FALSE(chosen_by_enter("Y.VRM"));
  const auto leave = [&] {
    for (int fields = 0; fields < 2; ++fields) type(GLFW_KEY_ESCAPE);
  };
  leave();
  bench.vrm = {"a figure", "an author", "no address"};
  EXPECT_FALSE(chosen_by_enter("y.vrm"));
  EXPECT_FALSE(bench.making_rig());
  leave();
  EXPECT_TRUE(chosen_by_enter("y.glb")) << "which needs none of them";
  EXPECT_TRUE(wait_for(bench, [&] { return !bench.busy(); }));
  bench.vrm.licence_url = "https://vrm.dev/licenses/1.0/";
  EXPECT_TRUE(chosen_by_enter("z.vrm"));
}

// The keys went to nothing, Tab to a button, and a blank in the figure's name pressed Cancel.
TEST_F(Typed, TheTextsOfAVrmFileAreTypedInOneGo) {
  panels.browser.ask(FileBrowser::Purpose::save, "Save the rig", "y.vrm");
  settle();
  type(GLFW_KEY_ENTER);
  const auto write = [&](const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    settle();
  };
  write("a figure");
  type(GLFW_KEY_TAB);
  write("an author");
  type(GLFW_KEY_TAB);
  write("no address");
  EXPECT_TRUE(panels.browser.shown());
  EXPECT_TRUE(panels.browser.lacks_fields());
  EXPECT_EQ(bench.vrm.name, "a figure");
  EXPECT_EQ(bench.vrm.author, "an author");
  EXPECT_EQ(bench.vrm.licence_url, "no address");
  for (int letters = 0; letters < 10; ++letters) type(GLFW_KEY_BACKSPACE);
  write("https://vrm.dev/licenses/1.0/");
  EXPECT_FALSE(panels.browser.lacks_fields()) << "it is no longer said";
  type(GLFW_KEY_ENTER);
  EXPECT_FALSE(panels.browser.shown()) << bench.vrm.licence_url;
}

}  // namespace
}  // namespace curveskel::viewer::panel_keys_laws
