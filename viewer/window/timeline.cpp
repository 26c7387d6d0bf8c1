#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/window/panels.hpp"

namespace curveskel::viewer {
namespace {

constexpr double least_ratio = 1e-9;  // the bottom of the logarithmic plots

/// 1 at the top, 0 at the bottom; logarithmic.
float height_of(double value) {
  const double share = 1 - std::log10(std::max(value, least_ratio)) / std::log10(least_ratio);
  return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

ImU32 colour_of(const std::string& stage) {
  if (stage == "input") return IM_COL32(130, 140, 150, 90);
  if (stage == "fair") return IM_COL32(80, 150, 220, 90);
  if (stage == "contract") return IM_COL32(60, 170, 140, 90);
  if (stage == "surgery") return IM_COL32(220, 170, 50, 100);
  if (stage == "rig") return IM_COL32(120, 100, 210, 110);
  return IM_COL32(220, 90, 60, 110);
}

struct Plot {
  const char* name;
  double Moment::*value;
  ImU32 colour;
};

constexpr Plot plots[] = {
    {"area", &Moment::area_ratio, IM_COL32(40, 110, 200, 255)},
    {"volume", &Moment::volume_ratio, IM_COL32(200, 60, 40, 255)},
    {"residual", &Moment::residual, IM_COL32(165, 110, 225, 255)},
};

void draw_title(const Scene& scene, bool roomy) {
  const Moment& shown = scene.recording.moments()[scene.moment];
  std::string title = fmt::format("{}   {} of {}", title_of(shown), scene.moment,
                                  scene.recording.moments().size() - 1);
  if (roomy && shown.surface) {
    title += fmt::format("   area {:.3g}   volume {:.3g}   residual {:.2g}", shown.area_ratio,
                         shown.volume_ratio, shown.residual);
  }
  ImGui::TextUnformatted(title.c_str());
}

/// Only where there are tries that were not kept.
void draw_choice_of_tries(Workbench& bench) {
  const Recording& recording = bench.scene->recording;
  if (!recording.has_other_tries() || bench.running()) return;
  ImGui::SameLine(0, 30);
  bool all = recording.shows_all_tries();
  if (ImGui::Checkbox("all tries", &all)) bench.show_all_tries(all);
}

}  // namespace

void draw_timeline(Workbench& bench, const Area& area) {
  if (area.width <= 0 || area.height <= 0) return;
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::Begin("timeline", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  draw_title(*bench.scene, area.width > ImGui::GetFontSize() * 44);
  for (const Plot& plot : plots) {
    ImGui::SameLine(0, plot.value == &Moment::area_ratio ? 30.0F : 12.0F);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(plot.colour), "%s", plot.name);
  }
  draw_choice_of_tries(bench);
  const auto& moments = bench.scene->recording.moments();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x,
                    std::max(ImGui::GetContentRegionAvail().y, 10.0F));
  ImGui::InvisibleButton("moments", size);
  const auto count = static_cast<float>(moments.size());
  if (ImGui::IsItemActive()) {
    const float share = (ImGui::GetIO().MousePos.x - low.x) / size.x;
    bench.go_to(
        static_cast<std::size_t>(std::clamp(share * count, 0.0F, std::max(count - 1, 0.0F))));
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float step = size.x / count;
  const auto x_of = [&](std::size_t i) { return low.x + step * (static_cast<float>(i) + 0.5F); };
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const float left = low.x + step * static_cast<float>(i);
    list.AddRectFilled({left, low.y},
                       {left + std::max(step - (step > 4 ? 1 : 0), 1.0F), low.y + size.y},
                       colour_of(moments[i].stage));
  }
  for (const Plot& plot : plots) {
    for (std::size_t i = 1; i < moments.size(); ++i) {
      const bool both = moments[i - 1].surface && moments[i].surface &&
                        moments[i].component == moments[i - 1].component &&
                        moments[i].try_number == moments[i - 1].try_number;
      if (!both) continue;
      const auto y_of = [&](std::size_t k) {
        return low.y + size.y * (1 - height_of(moments[k].*plot.value));
      };
      list.AddLine({x_of(i - 1), y_of(i - 1)}, {x_of(i), y_of(i)}, plot.colour, 1.6F);
    }
  }
  const float cursor = x_of(bench.scene->moment);
  list.AddRectFilled({cursor - 1.5F, low.y}, {cursor + 1.5F, low.y + size.y},
                     ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::End();
}

}  // namespace curveskel::viewer
