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

/// A list of the table's names, each with its meaning.
template <typename Choice, std::size_t Count>
void choose(const char* label, Choice& value, const NameTable<Choice, Count>& table) {
  const std::string now(name_of(table, value));
  if (!ImGui::BeginCombo(label, now.c_str())) return;
  for (const auto& entry : table) {
    const std::string name(entry.name);
    if (ImGui::Selectable(name.c_str(), entry.value == value)) value = entry.value;
    tip(std::string(entry.meaning).c_str());
  }
  ImGui::EndCombo();
}

/// Run, parameters, corrections.
void draw_left_panel(Workbench& bench, Panels& panels, const Area& area);
/// Look, certificate, rig, input.
void draw_right_panel(Workbench& bench, Panels& panels, const Area& area);

}  // namespace curveskel::viewer
