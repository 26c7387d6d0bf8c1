// Areas of the panels that differ from the last picture. Without a graphics card, text and plain
// areas take longer to draw than a picture of the surface.
#pragma once

#include <imgui.h>

#include <vector>

#include "viewer/window/panels.hpp"

namespace curveskel::viewer {

class PanelChanges {
 public:
  /// Areas that hold all that differs from the last call's data; all of the window at first.
  [[nodiscard]] std::vector<Area> since_last(const ImDrawData& data);

 private:
  /// A list of ImGui's, which are made anew in every frame.
  struct Kept {
    std::vector<ImDrawVert> vertices;
    std::vector<ImDrawIdx> indices;
    std::vector<ImDrawCmd> commands;
  };
  static Kept copy_of(const ImDrawList& list);
  static bool same_commands(const Kept& one, const Kept& other);
  static void add_changes(const Kept& before, const Kept& now, std::vector<Area>& areas);

  std::vector<Kept> kept_;
};

/// Draws the content of the area.
void draw_within(ImDrawData& data, const Area& area);

}  // namespace curveskel::viewer
