// Dear ImGui without a window: what it draws is never shown.
#pragma once

#include <imgui.h>

namespace curveskel::viewer {

/// The current context as long as it lives, with fonts and a display of the given size.
class ImGuiContextWithoutWindow {
 public:
  ImGuiContextWithoutWindow(float width, float height) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    unsigned char* pixels = nullptr;
    int pixels_across = 0;
    int pixels_down = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &pixels_across, &pixels_down);
  }
  ~ImGuiContextWithoutWindow() { ImGui::DestroyContext(); }
  ImGuiContextWithoutWindow(const ImGuiContextWithoutWindow&) = delete;
  ImGuiContextWithoutWindow& operator=(const ImGuiContextWithoutWindow&) = delete;
};

}  // namespace curveskel::viewer
