#include "viewer/window/panel_keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <utility>

namespace curveskel::viewer {
namespace {

/// In the order in which Tab goes through them.
constexpr std::array<const char*, 3> panel_names{"run", "look", "timeline"};

ImGuiWindow* shown_panel(std::size_t number) {
  ImGuiWindow* const panel = ImGui::FindWindowByName(panel_names[number]);
  return panel != nullptr && panel->WasActive ? panel : nullptr;
}

/// The panel after this window, or before it; the first or the last one after none.
ImGuiWindow* panel_beside(const ImGuiWindow* window, int direction) {
  const int count = static_cast<int>(panel_names.size());
  int at = direction > 0 ? -1 : count;
  for (int i = 0; i < count; ++i) {
    if (shown_panel(static_cast<std::size_t>(i)) == window && window != nullptr) at = i;
  }
  for (int step = 0; step < count; ++step) {
    at = (at + direction + count) % count;
    if (ImGuiWindow* const found = shown_panel(static_cast<std::size_t>(at))) return found;
  }
  return nullptr;
}

}  // namespace

bool is_list_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool is_pressed_by_key() {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  const ImGuiID item = g.LastItemData.ID;
  return item != 0 && g.NavActivatePressedId == item;
}

/// ImGui's own Tab goes to fields alone, so that it is not told of Tab. The control is found while
/// the panels are laid out in this frame.
void PanelKeys::ask(int direction) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.NavWindow == nullptr) return;
  if (g.ActiveId != 0) ImGui::ClearActiveID();
  const ImGuiDir way = direction > 0 ? ImGuiDir_Down : ImGuiDir_Up;
  ImGui::NavMoveRequestSubmit(
      ImGuiDir_None, way, ImGuiNavMoveFlags_Tabbing | ImGuiNavMoveFlags_FocusApi,
      ImGuiScrollFlags_KeepVisibleEdgeX | ImGuiScrollFlags_KeepVisibleEdgeY);
  g.NavTabbingResultFirst.Clear();
  g.NavTabbingDir = direction;
  g.NavTabbingCounter = g.NavId == 0 && direction > 0 ? 1 : -1;
  asked_ = direction;
}

/// To the first or the last control of the panel beside.
void PanelKeys::go(int direction) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  ImGuiWindow* const panel = panel_beside(g.NavWindow, direction);
  if (panel == nullptr) {
    goes_on_ = direction;  // once they are shown
    return;
  }
  ImGui::FocusWindow(panel);
  g.NavId = 0;
  g.NavLayer = ImGuiNavLayer_Main;
  ask(direction);
}

/// Keys come with a question or a list, but not one that went down before it, and go with it.
void PanelKeys::heed(Over over, bool clicked) {
  const bool dialogue = over == Over::dialogue || over == Over::question;
  const bool has_keys = over == Over::list || over == Over::question;
  if (on_ && (by_itself_ ? !has_keys : clicked || (of_dialogue_ && !dialogue))) leave();
  const bool held = ImGui::IsKeyDown(GLFW_KEY_ENTER) || ImGui::IsKeyDown(GLFW_KEY_KP_ENTER) ||
                    ImGui::IsKeyDown(GLFW_KEY_SPACE);
  if (on_ || !has_keys || held) return;
  on_ = by_itself_ = true;
  of_dialogue_ = dialogue;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  if (over == Over::question) ImGui::GetCurrentContext()->NavDisableHighlight = false;
}

bool PanelKeys::begin(Over over) {
  const bool dialogue = over == Over::dialogue || over == Over::question;
  ImGuiContext& g = *ImGui::GetCurrentContext();
  ImGuiIO& io = ImGui::GetIO();
  io.KeyMap[ImGuiKey_Tab] = -1;
  const bool has_come = std::exchange(asked_before_, 0) != 0;
  if (has_come) {
    // ImGui begins to edit a field that it comes to so: for dialogues alone, where texts are typed
    // one after the other.
    g.NavActivateId = 0;
    if (!of_dialogue_) g.NavActivateInputId = 0;
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
  }
  const bool clicked = std::any_of(std::begin(io.MouseClicked), std::end(io.MouseClicked),
                                   [](bool one) { return one; });
  if (on_ && !has_come && g.NavActivateInputId != 0) {
    // In ImGui 1.86, Enter is for fields alone.
    g.NavActivateId = g.NavActivateDownId = g.NavActivatePressedId = g.NavActivateInputId;
  }
  escape_is_theirs_ = on_ && was_in_use_;  // though it may have closed the list by now
  heed(over, clicked);
  if (const int on = std::exchange(goes_on_, 0); on != 0 && on_) go(on);
  const bool tab = ImGui::IsKeyPressed(GLFW_KEY_TAB, false) && !io.KeyCtrl && !io.KeyAlt;
  if (!tab) return false;
  const int direction = io.KeyShift ? -1 : 1;
  if (!on_) of_dialogue_ = dialogue;
  if (!std::exchange(on_, true) && !dialogue) {
    ImGui::FocusWindow(nullptr);
    goes_on_ = direction;
  } else {
    ask(direction);
  }
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  return true;
}

void PanelKeys::end() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  was_in_use_ = ImGui::IsAnyItemActive() || is_list_open();
  asked_before_ = std::exchange(asked_, 0);
  // Before the first control of a panel ImGui would go round to its last.
  const bool goes_round = asked_before_ < 0 && g.NavId != 0 && g.NavMoveScoringItems;
  const bool found = g.NavMoveResultLocal.ID != 0 && !goes_round;
  if (asked_before_ == 0 || found || of_dialogue_ || is_list_open()) return;
  ImGui::NavMoveRequestCancel();
  goes_on_ = std::exchange(asked_before_, 0);
}

void PanelKeys::leave() {
  on_ = by_itself_ = false;
  asked_ = asked_before_ = goes_on_ = 0;
  ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  ImGui::GetCurrentContext()->NavDisableHighlight = true;
  if (!is_list_open()) ImGui::FocusWindow(nullptr);  // which would close it
}

}  // namespace curveskel::viewer
