// Questions before something is lost.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/window/panel_parts.hpp"

namespace curveskel::viewer {
namespace {

struct Choice {
  const char* label;
  char key;  // 0 = Esc, which the controls hear
};

/// The number of the choice made in this frame, or -1.
int draw_choices(std::span<const Choice> offered) {
  int chosen = -1;
  const float width = 6 * ImGui::GetFontSize();
  for (std::size_t i = 0; i < offered.size(); ++i) {
    const Choice& one = offered[i];
    if (i > 0) ImGui::SameLine();
    const bool typed = one.key != 0 && ImGui::IsKeyPressed(one.key, false);
    if (ImGui::Button(one.label, {width, 0}) || typed) chosen = static_cast<int>(i);
    if (one.key == 0) ImGui::SetItemDefaultFocus();  // nothing is lost by it
    tip(one.key == 0 ? "Esc" : std::string(1, one.key).c_str());
  }
  return chosen;
}

/// Over all else while it is to be asked; the number of the choice made in this frame, or -1.
int answer(const char* title, bool asked, const std::string& text,
           std::span<const Choice> offered) {
  if (asked && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (!ImGui::BeginPopupModal(title, nullptr, flags)) return -1;
  int chosen = -1;
  if (asked) {
    ImGui::PushTextWrapPos(std::min(40 * ImGui::GetFontSize(), screen.x * 0.8F));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    chosen = draw_choices(offered);
  }
  if (!asked || chosen >= 0) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

void ask_to_replace(Workbench& bench) {
  constexpr std::array<Choice, 2> offered{{{"Replace", 'R'}, {"Keep it", 0}}};
  const bool asked = bench.wants_to_replace.has_value();
  const std::string file = asked ? bench.wants_to_replace->string() : "";
  const int chosen = answer("Replace a file?", asked, file + " is there already.", offered);
  if (chosen < 0) return;
  bench.wants_to_replace.reset();
  if (chosen == 0) bench.save(file, true);
}

/// `wait_or_save` begins what keeps all.
void abandon(Workbench& bench, Panels& panels, int chosen,
             const std::function<void()>& wait_or_save) {
  if (chosen < 0) return;
  const auto files = *std::exchange(bench.wants_to_abandon, std::nullopt);
  if (chosen == 0) {
    bench.after_saving = files;
    wait_or_save();
  } else if (chosen == 1 && files.empty()) {
    panels.may_leave = true;
  } else if (chosen == 1) {
    bench.open(files, true);
  }
}

void ask_to_abandon(Workbench& bench, Panels& panels) {
  constexpr std::array<Choice, 3> offered{{{"Save", 'S'}, {"Discard", 'D'}, {"Stay", 0}}};
  const bool asked = bench.wants_to_abandon && bench.saving_rig_to().empty();
  const int chosen =
      answer("Discard corrections?", asked, "The corrections by hand are in no file yet.", offered);
  abandon(bench, panels, chosen, [&] { ask_to_save(bench, panels); });
}

/// A save that waits for its rig has the corrections, too.
void ask_to_abandon_save(Workbench& bench, Panels& panels) {
  constexpr std::array<Choice, 3> offered{{{"Wait", 'W'}, {"Discard", 'D'}, {"Stay", 0}}};
  const std::string file = bench.saving_rig_to().string();
  const bool asked = bench.wants_to_abandon && !file.empty();
  const int chosen = answer("Discard the rig?", asked,
                            file + " is not saved yet: its rig is still being made.", offered);
  abandon(bench, panels, chosen, [] {});
}

}  // namespace

void questions(Workbench& bench, Panels& panels) {
  ask_to_replace(bench);
  if (!bench.would_lose()) bench.wants_to_abandon.reset();
  if (!bench.wants_to_replace) {  // one after the other
    ask_to_abandon(bench, panels);
    ask_to_abandon_save(bench, panels);
  }
  const bool saves =
      panels.browser.shown() || bench.wants_to_replace || !bench.saving_rig_to().empty();
  if (!saves) bench.after_saving.reset();  // it was cancelled, or failed
}

}  // namespace curveskel::viewer
