#include "viewer/window/timeline.hpp"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/window/panels.hpp"

namespace curveskel::viewer {

int component_at(const std::vector<Moment>& moments, std::size_t moment) {
  const auto is_of_one = [](const Moment& one) { return one.surface || one.stage == "surgery"; };
  for (std::size_t i = std::min(moment + 1, moments.size()); i-- > 0;) {
    if (is_of_one(moments[i])) return moments[i].component;
  }
  const auto first = std::find_if(moments.begin(), moments.end(), is_of_one);
  return first == moments.end() ? -1 : first->component;
}

std::vector<std::size_t> moments_of(const std::vector<Moment>& moments, int component) {
  std::vector<std::size_t> of_it;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (moments[i].surface && moments[i].component == component) of_it.push_back(i);
  }
  return of_it;
}

PlotRange range_of_residuals(const std::vector<Moment>& moments,
                             const std::vector<std::size_t>& plotted) {
  PlotRange range;
  for (const std::size_t i : plotted) {
    const double residual = moments[i].residual;
    if (!(residual > 0)) continue;
    range.low = range.low > 0 ? std::min(range.low, residual) : residual;
    range.high = std::max(range.high, residual);
  }
  if (range.high <= 0) return {0.1, 1};
  constexpr double decade = 10;
  return range.high < range.low * decade ? PlotRange{range.low / decade, range.high * decade}
                                         : range;
}

float height_of(double value, const PlotRange& range) {
  if (!(value > range.low)) return 0;
  const double share = std::log(value / range.low) / std::log(range.high / range.low);
  return static_cast<float>(std::min(share, 1.0));
}

namespace {

constexpr PlotRange ratios{1e-9, 1};

/// Fainter for other components than the one that is plotted.
ImU32 colour_of(const std::string& stage, bool faint) {
  const int alpha = faint ? 35 : 100;
  if (stage == "input") return IM_COL32(130, 140, 150, alpha);
  if (stage == "fair") return IM_COL32(80, 150, 220, alpha);
  if (stage == "contract") return IM_COL32(60, 170, 140, alpha);
  if (stage == "surgery") return IM_COL32(220, 170, 50, alpha);
  if (stage == "rig") return IM_COL32(120, 100, 210, alpha);
  return IM_COL32(220, 90, 60, alpha);
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

void draw_title(const Scene& scene, int component, bool roomy) {
  const Moment& shown = scene.recording.moments()[scene.moment];
  std::string title = fmt::format("{}   {} of {}", title_of(shown), scene.moment,
                                  scene.recording.moments().size() - 1);
  if (roomy && shown.surface) {
    title += fmt::format("   area {:.3g}   volume {:.3g}   residual {:.2g}", shown.area_ratio,
                         shown.volume_ratio, shown.residual);
  }
  int last = 0;
  for (const Moment& moment : scene.recording.moments()) last = std::max(last, moment.component);
  if (last > 0 && component >= 0) {
    title += fmt::format("   component {} of {}", component + 1, last + 1);
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

/// Those of the component; tries are not connected with each other.
void draw_plots(const std::vector<Moment>& moments, int component, const ImVec2& low,
                const ImVec2& size) {
  const std::vector<std::size_t> plotted = moments_of(moments, component);
  const PlotRange residuals = range_of_residuals(moments, plotted);
  const float step = size.x / static_cast<float>(moments.size());
  for (const Plot& plot : plots) {
    const PlotRange& range = plot.value == &Moment::residual ? residuals : ratios;
    const auto place_of = [&](std::size_t i) {
      return ImVec2(low.x + step * (static_cast<float>(i) + 0.5F),
                    low.y + size.y * (1 - height_of(moments[i].*plot.value, range)));
    };
    for (std::size_t k = 1; k < plotted.size(); ++k) {
      if (moments[plotted[k]].try_number != moments[plotted[k - 1]].try_number) continue;
      ImGui::GetWindowDrawList()->AddLine(place_of(plotted[k - 1]), place_of(plotted[k]),
                                          plot.colour, 1.6F);
    }
  }
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
  const auto& moments = bench.scene->recording.moments();
  const int component = component_at(moments, bench.scene->moment);
  draw_title(*bench.scene, component, area.width > ImGui::GetFontSize() * 44);
  for (const Plot& plot : plots) {
    ImGui::SameLine(0, plot.value == &Moment::area_ratio ? 30.0F : 12.0F);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(plot.colour), "%s", plot.name);
  }
  draw_choice_of_tries(bench);
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
    const bool is_other = moments[i].surface && moments[i].component != component;
    list.AddRectFilled({left, low.y},
                       {left + std::max(step - (step > 4 ? 1 : 0), 1.0F), low.y + size.y},
                       colour_of(moments[i].stage, is_other));
  }
  draw_plots(moments, component, low, size);
  const float cursor = x_of(bench.scene->moment);
  list.AddRectFilled({cursor - 1.5F, low.y}, {cursor + 1.5F, low.y + size.y},
                     ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::End();
}

}  // namespace curveskel::viewer
