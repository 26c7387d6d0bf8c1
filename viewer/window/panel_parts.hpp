// The parts of panels.
#pragma once

#include <string>

#include <curveskel/advanced/names.hpp>
#include "viewer/window/panels.hpp"
// ImGui after what has no need of it.
#include <imgui.h>

namespace curveskel::viewer {

/// A window that stays where it is put; false where there is no room for it. End it by ImGui::End.
[[nodiscard]] bool begin_panel(const char* name, const Area& area);

/// Shown while the pointer rests on the last item.
void tip(const char* text);

/// Puts the next button beside the last one, where there is room for one with this label.
void beside_if_it_fits(const char* label);
/// The same for a box to tick.
void box_beside_if_it_fits(const char* label);

/// Before a control: gives it this share of the panel's width, with its label beside it, and room
/// for a small button after that. Where the label would be cut off, it is written above the
/// control, which has the whole width. The name to give the control.
[[nodiscard]] std::string place_control(const char* label, float share);
/// A box to tick, its label in several lines where it would be cut off.
bool tick(const char* label, bool& value);

/// Within an open list: a line of it. The present one is seen when the list opens.
[[nodiscard]] bool list_line(const char* label, bool present);
/// Within an open list: Esc closes it.
void close_by_escape();

/// Read against the panel of the theme: 4.5 to 1 at least.
[[nodiscard]] ImVec4 verdict_colour(bool good, Theme theme);

/// Of a panel's width, for a control that has its label beside it.
inline constexpr float control_share = 0.48F;

/// A list of the table's names, each with its meaning.
template <typename Choice, std::size_t Count>
void choose(const char* label, Choice& value, const NameTable<Choice, Count>& table,
            const char* meaning) {
  const std::string now(name_of(table, value));
  const std::string name_of_list = place_control(label, control_share);
  const bool open = ImGui::BeginCombo(name_of_list.c_str(), now.c_str());
  if (!open) tip(meaning);
  if (!open) return;
  for (const auto& entry : table) {
    const std::string name(entry.name);
    if (list_line(name.c_str(), entry.value == value)) value = entry.value;
    tip(std::string(entry.meaning).c_str());
  }
  close_by_escape();
  ImGui::EndCombo();
}

/// Before a file is replaced, or corrections are lost.
void questions(Workbench& bench, Panels& panels);
/// Run, parameters, corrections.
void draw_left_panel(Workbench& bench, Panels& panels, const Area& area);
/// First of all in the right panel, where there is a rig: it is what a person has asked for. Its
/// joints scroll within a part of the panel, so that the rest stays at hand.
void draw_rig_section(Workbench& bench, Panels& panels);
/// Look, certificate, rig, input.
void draw_right_panel(Workbench& bench, Panels& panels, const Area& area);

}  // namespace curveskel::viewer
