#include "viewer/window/timeline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "viewer/window/panel_parts.hpp"

namespace curveskel::viewer {

namespace {

bool is_of_one(const Moment& moment) { return moment.surface || moment.stage == "surgery"; }

}  // namespace

int component_at(const std::vector<Moment>& moments, std::size_t moment) {
  if (moment < moments.size() && is_of_one(moments[moment])) return moments[moment].component;
  const Moment* largest = nullptr;
  for (const Moment& one : moments) {
    if (!one.surface) continue;
    const bool larger =
        largest == nullptr || one.surface->positions.size() > largest->surface->positions.size();
    if (larger) largest = &one;
  }
  return largest == nullptr ? -1 : largest->component;
}

std::vector<std::size_t> moments_with(const std::vector<Moment>& moments, int component) {
  std::vector<std::size_t> with_it;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (!is_of_one(moments[i]) || moments[i].component == component) with_it.push_back(i);
  }
  return with_it;
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

ImU32 colour_of(const std::string& stage) {
  constexpr int alpha = 100;
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
  const char* meaning;
  ImU32 on_light;
  ImU32 on_dark;
  [[nodiscard]] ImU32 colour_on(Theme theme) const {
    return theme == Theme::dark ? on_dark : on_light;
  }
};

constexpr Plot plots[] = {
    {"area", &Moment::area_ratio, "of the surface, as a share of what it had; logarithmic",
     IM_COL32(30, 95, 185, 255), IM_COL32(110, 175, 255, 255)},
    {"volume", &Moment::volume_ratio, "of the surface, as a share of what it had; logarithmic",
     IM_COL32(185, 45, 30, 255), IM_COL32(255, 125, 105, 255)},
    {"residual", &Moment::residual, "how far each solve was from exact; logarithmic",
     IM_COL32(120, 65, 190, 255), IM_COL32(200, 150, 255, 255)},
};

/// Goes on in the line where text of this width has room in it; false where it has none.
bool has_room(float distance, float text_width) {
  const float right = ImGui::GetItemRectMax().x + distance + text_width;
  if (right > ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) return false;
  ImGui::SameLine(0, distance);
  return true;
}

void draw_title(const Scene& scene, const std::vector<std::size_t>& shown_moments, bool roomy) {
  const Moment& shown = scene.recording.moments()[scene.moment];
  const auto at = std::find(shown_moments.begin(), shown_moments.end(), scene.moment);
  std::string title = title_of(shown);
  if (shown_moments.size() > 1) {
    title += fmt::format("   {} of {}", at - shown_moments.begin(), shown_moments.size() - 1);
  }
  if (roomy && shown.surface) {
    title += fmt::format("   area {:.3g}   volume {:.3g}   residual {:.2g}", shown.area_ratio,
                         shown.volume_ratio, shown.residual);
  }
  ImGui::TextUnformatted(title.c_str());
}

/// The names of the plots, as many as have room beside the title.
void draw_names_of_plots(Theme theme) {
  const float letter = ImGui::GetFontSize();
  for (const Plot& plot : plots) {
    const float distance = plot.value == &Moment::area_ratio ? 2 * letter : letter;
    if (!has_room(distance, ImGui::CalcTextSize(plot.name).x)) return;
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(plot.colour_on(theme)), "%s", plot.name);
    tip(plot.meaning);
  }
}

/// Only where there are several: which one, and ways to those beside it.
void draw_choice_of_component(Workbench& bench, int component) {
  const auto& moments = bench.scene->recording.moments();
  int last = 0;
  for (const Moment& moment : moments) last = std::max(last, moment.component);
  if (last == 0 || component < 0) return;
  const std::string words = fmt::format("component {} of {}", component + 1, last + 1);
  const float letter = ImGui::GetFontSize();
  (void)has_room(letter, ImGui::CalcTextSize(words.c_str()).x + 6 * letter);
  const auto go_beside = [&](const char* arrow, int other, const char* meaning) {
    ImGui::BeginDisabled(other < 0 || other > last);
    const bool pressed = ImGui::SmallButton(arrow);
    ImGui::EndDisabled();
    tip(meaning);
    for (std::size_t i = moments.size(); pressed && i-- > 0;) {
      if (!moments[i].surface || moments[i].component != other) continue;
      bench.go_to(i);
      return;
    }
  };
  go_beside("<", component - 1, "the component before");
  ImGui::SameLine();
  ImGui::TextUnformatted(words.c_str());
  ImGui::SameLine();
  go_beside(">", component + 1, "the next component");
}

/// Only where there are tries that were not kept. True if all are to be shown.
bool draw_choice_of_tries(const Workbench& bench) {
  const Recording& recording = bench.scene->recording;
  if (!recording.has_other_tries() || bench.running()) return recording.shows_all_tries();
  const float letter = ImGui::GetFontSize();
  (void)has_room(2 * letter, ImGui::CalcTextSize("all tries").x + 2 * letter);
  bool all = recording.shows_all_tries();
  ImGui::Checkbox("all tries", &all);
  return all;
}

/// The moments as steps, with the plots of the component; tries are not connected with each other.
void draw_moments(const std::vector<Moment>& moments, const std::vector<std::size_t>& shown,
                  const ImVec2& low, const ImVec2& size, Theme theme) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float step = size.x / static_cast<float>(shown.size());
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const float left = low.x + step * static_cast<float>(k);
    list.AddRectFilled({left, low.y},
                       {left + std::max(step - (step > 4 ? 1 : 0), 1.0F), low.y + size.y},
                       colour_of(moments[shown[k]].stage));
  }
  const PlotRange residuals = range_of_residuals(moments, shown);
  for (const Plot& plot : plots) {
    const PlotRange& range = plot.value == &Moment::residual ? residuals : ratios;
    const auto place_of = [&](std::size_t k) {
      return ImVec2(low.x + step * (static_cast<float>(k) + 0.5F),
                    low.y + size.y * (1 - height_of(moments[shown[k]].*plot.value, range)));
    };
    for (std::size_t k = 1; k < shown.size(); ++k) {
      const Moment& before = moments[shown[k - 1]];
      const Moment& after = moments[shown[k]];
      const bool has_both = before.surface && after.surface && before.*plot.value > 0 &&
                            after.*plot.value > 0 && before.try_number == after.try_number;
      if (has_both) list.AddLine(place_of(k - 1), place_of(k), plot.colour_on(theme), 1.6F);
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
  const std::vector<std::size_t> shown = moments_with(moments, component);
  draw_title(*bench.scene, shown, area.width > ImGui::GetFontSize() * 60);
  if (shown.size() > 1) draw_names_of_plots(bench.scene->look.theme);
  draw_choice_of_component(bench, component);
  const bool all_tries = draw_choice_of_tries(bench);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x,
                    std::max(ImGui::GetContentRegionAvail().y, 10.0F));
  ImGui::InvisibleButton("moments", size);
  const auto count = static_cast<float>(shown.size());
  if (ImGui::IsItemActive()) {
    const float share = (ImGui::GetIO().MousePos.x - low.x) / size.x;
    const float place = std::clamp(share * count, 0.0F, std::max(count - 1, 0.0F));
    bench.go_to(shown[static_cast<std::size_t>(place)]);
  }
  draw_moments(moments, shown, low, size, bench.scene->look.theme);
  const auto at = std::find(shown.begin(), shown.end(), bench.scene->moment);
  const float step = size.x / count;
  const float cursor = low.x + step * (static_cast<float>(at - shown.begin()) + 0.5F);
  ImGui::GetWindowDrawList()->AddRectFilled({cursor - 1.5F, low.y}, {cursor + 1.5F, low.y + size.y},
                                            ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::End();
  // Last, as other moments take the place of those that were drawn.
  if (all_tries != bench.scene->recording.shows_all_tries()) bench.show_all_tries(all_tries);
}

}  // namespace curveskel::viewer
