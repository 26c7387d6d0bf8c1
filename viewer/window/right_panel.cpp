// Look, certificate, input.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/window/panel_parts.hpp"

namespace curveskel::viewer {
namespace {

void look_controls(Look& look, Camera& camera) {
  choose("surface", look.surface, surface_styles, "how the surface is drawn (S)");
  choose("its colours", look.surface_colour, colourings, "what the surface's colours say");
  choose("skeleton", look.skeleton, skeleton_styles, "how the skeleton is drawn (K)");
  choose("its colours ", look.skeleton_colour, colourings, "what the skeleton's colours say");
  choose("map", look.map, colour_maps, "colours of numbers, such as radius and weight");
  choose("theme", look.theme, themes, "L");
  ImGui::SliderFloat(place_control("opacity", control_share).c_str(), &look.opacity, 0, 1, "%.2f",
                     ImGuiSliderFlags_AlwaysClamp);
  tip("of the transparent surface");
  ImGui::SliderFloat(place_control("thickness", control_share).c_str(), &look.thickness, 0.2F, 5,
                     "%.2f", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tip("of tubes and lines");
  tick("edges", look.edges);
  tip("of the surface, over its faces (E)");
  box_beside_if_it_fits("joints");
  tick("joints", look.joints);
  tip("the skeleton's tips and junctions as balls");
  box_beside_if_it_fits("through");
  tick("through", look.through);
  tip("the skeleton shows through an opaque surface");
  tick("bones", look.bones);
  tip("joints and bones of a rig");
  box_beside_if_it_fits("parallel projection");
  tick("parallel projection", camera.orthographic);
  tip("what is farther away is no smaller (O)");
}

/// The figure below its name where there is no room beside it.
void certificate_line(const char* name, const std::string& value, int verdict, Theme theme,
                      const char* meaning) {
  const ImVec4 colour =
      verdict < 0 ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : verdict_colour(verdict != 0, theme);
  const float column = ImGui::GetFontSize() * 7.5F;
  ImGui::BeginGroup();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::TextWrapped("%s", name);
  if (column + ImGui::CalcTextSize(value.c_str()).x <= room) {
    ImGui::SameLine(column);
  } else {
    ImGui::Indent();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", value.c_str());
  ImGui::PopStyleColor();
  if (column + ImGui::CalcTextSize(value.c_str()).x > room) ImGui::Unindent();
  ImGui::EndGroup();
  tip(meaning);
}

const char* why_not_judged(const Workbench& bench) {
  const bool has_surface = bench.scene->document.has_surface();
  if (bench.scene->skeleton() && !has_surface) {
    return "open the surface and the skeleton together to judge it";
  }
  if (bench.running() || bench.judging() || !has_surface) return "not there yet";
  return bench.history().empty() ? "extract the skeleton (Space), which is judged then"
                                 : "of the skeleton, at the end of the timeline (End)";
}

/// Puts down lines of the certificate in the theme's colours.
struct CertificateLines {
  Theme theme;

  void operator()(const char* name, const std::string& value, int verdict,
                  const char* meaning) const {
    certificate_line(name, value, verdict, theme, meaning);
  }
};

/// The figures that have to be right.
void verdicts(Workbench& bench, const Judgement& found, const CertificateLines& line) {
  const Certificate& c = found.certificate;
  const auto verdict = [](bool good) { return good ? 1 : 0; };
  line("components", fmt::format("{} of {}", c.components, c.components_of_surface),
       verdict(c.components_right()),
       "Pieces of the skeleton, and of the surface. Green figures are as they have to be, red ones "
       "are faults, the others only tell.");
  line("cycles", fmt::format("{}, genus {}", c.cycle_rank, c.genus),
       verdict(c.cycle_rank == c.genus),
       "Rings of the skeleton, and handles of the surface, as a cup has one: as many.");
  line("handles", fmt::format("round {} of {}", c.homology_rank, c.genus),
       verdict(c.homology_rank == c.genus), "Handles of the surface that a ring runs through.");
  line("inside", fmt::format("{:.2f} %", 100 * c.inside_fraction), verdict(c.inside_enough),
       "Share of the skeleton's length that lies inside the surface; 99.9 % have to.");
  if (!found.findings.exits.empty()) {
    beside_if_it_fits("show");
    if (ImGui::SmallButton("show##exits")) bench.show_exits();
    tip("the edges that leave the surface");
  }
  line("ahead of tips", fmt::format("{:.4f} D", c.reach_at_tips), verdict(c.reaches_ends()),
       "The farthest that the surface goes on beyond the end of a branch; up to 0.1 D is right. D "
       "is the diagonal of the box round the model.");
  line("tubes", fmt::format("{:.1f} % of the area", 100 * c.tube_share), verdict(c.curve_like),
       "Share of the surface that is like a tube round the skeleton. Below a half it is made of "
       "plates or leaves, for which no curve stands.");
  if (c.wrap_followed < 1) {
    line("wrap follows", fmt::format("{:.1f} % of the area", 100 * c.wrap_followed),
         verdict(c.wrap_follows()),
         "The surface was wrapped, as it encloses nothing by itself: how much of the wrap lies at "
         "the given faces; 75 % have to.");
  }
  line("spurs", fmt::format("{}", c.spurs), verdict(c.spurs == 0),
       "Branches that do not come out of the ball at the junction where they begin.");
  if (c.spurs > 0) {
    beside_if_it_fits("show");
    if (ImGui::SmallButton("show##spurs")) bench.show_spurs();
    tip("the edges of those branches");
  }
}

/// A curve outside has none: its distance counts as without end.
std::string centredness_words(double median, double p90) {
  if (!std::isfinite(median)) return "none, half or more is outside";
  if (!std::isfinite(p90)) return fmt::format("{:.3f}, a tenth or more is outside", median);
  return fmt::format("{:.3f}, p90 {:.3f}", median, p90);
}

/// The figures that only tell.
void measures(const Certificate& c, const CertificateLines& line) {
  line("deepest exit", fmt::format("{:.2g} D", c.deepest_exit), -1,
       "How far the skeleton comes out of the surface; D is the diagonal of the box round the "
       "model.");
  line("centredness", centredness_words(c.centredness_median, c.centredness_p90), -1,
       "How unequal the ways to the surface all round the skeleton are: 0 = in the very middle. In "
       "the median, and for 90 % of the length. A flat part has no better than 0.25 to 0.5.");
  line("coverage", fmt::format("{:.1f} %", 100 * c.coverage), -1,
       "Share of the surface within 1.5 inscribed radii of the skeleton.");
  line("reach", fmt::format("{:.4f} D", c.reach), -1,
       "How far the surface is from the skeleton's inscribed balls, but for the farthest 5 %.");
  line("tips", fmt::format("{}", c.tips), -1, "Ends of branches.");
  line("junctions", fmt::format("{}", c.junctions), -1, "Nodes where three branches or more meet.");
  line("length", fmt::format("{:.3f} D", c.length), -1,
       "Of the whole skeleton, in diagonals of the box round the model.");
  line("total curvature", fmt::format("{:.1f} rad/D", c.total_curvature), -1,
       "How much the skeleton bends along its length: low where it runs smoothly.");
}

void certificate(Workbench& bench) {
  const Judgement* found = bench.judgement();
  if (found == nullptr) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", why_not_judged(bench));
    ImGui::PopStyleColor();
    return;
  }
  if (!found->error.empty()) {
    ImGui::TextWrapped("%s", found->error.c_str());
    return;
  }
  const CertificateLines line{bench.scene->look.theme};
  verdicts(bench, *found, line);
  measures(found->certificate, line);
}

/// Seconds of the stages, of the embedding also of its steps.
void times(const Workbench& bench) {
  const RunResult* const result = bench.result();
  const Extraction* const found = result == nullptr ? nullptr : result->extraction.get();
  if (found == nullptr) {
    ImGui::TextDisabled("not there yet");
    return;
  }
  const float column = ImGui::GetContentRegionAvail().x * 0.6F;
  const auto seconds = [column](double value) {
    ImGui::SameLine(column);
    const std::string text =
        value < 1 ? fmt::format("{:.1f} ms", 1e3 * value) : fmt::format("{:.2f} s", value);
    ImGui::TextUnformatted(text.c_str());
  };
  for (const StageTime& time : found->times) {
    const ImGuiTreeNodeFlags leaf = time.steps.empty() ? ImGuiTreeNodeFlags_Leaf : 0;
    const bool open = ImGui::TreeNodeEx(time.stage.c_str(), leaf);
    seconds(time.seconds);
    if (!open) continue;
    ImGui::Indent();
    for (const StepTime& step : time.steps) {
      ImGui::TextUnformatted(step.step.c_str());
      seconds(step.seconds);
      if (step.outside == 0) continue;
      ImGui::SameLine();
      ImGui::TextDisabled("%d outside", step.outside);
      tip("points of the curve outside the surface after the step");
    }
    ImGui::Unindent();
    ImGui::TreePop();
  }
}

/// Of the file itself.
void input_defects(Workbench& bench) {
  const Defects& found = *bench.defects();
  const auto line = [&](const char* name, const std::vector<int>& faces, const char* meaning) {
    if (faces.empty()) return;
    ImGui::Text("%s: %d", name, static_cast<int>(faces.size()));
    tip(meaning);
    ImGui::SameLine();
    ImGui::PushID(name);
    if (ImGui::SmallButton("show")) bench.show_faces(faces);
    ImGui::PopID();
  };
  line("open", found.open, "with an edge that no other face has: at a hole or a border");
  line("non-manifold", found.non_manifold, "with an edge that three faces or more have");
  line("flipped", found.flipped, "facing the other way than a neighbour");
  line("degenerate", found.degenerate, "with a corner twice, or no area");
}

/// The values and the name of the colour bar; nothing if colours are no numbers.
std::optional<std::pair<ColourScale, const char*>> scale_shown(const Workbench& bench) {
  const Look& look = bench.scene->look;
  if (bench.scene->look_now().surface_colour == ColourBy::weight && bench.selected_joint() >= 0) {
    return std::pair{ColourScale{0, 1}, "weight"};
  }
  const bool by_radius =
      look.surface_colour == ColourBy::radius || look.skeleton_colour == ColourBy::radius;
  const auto skeleton = bench.scene->skeleton();
  if (!by_radius || !skeleton) return std::nullopt;
  const auto scale = radius_scale(*skeleton);
  if (!scale) return std::nullopt;
  return std::pair{*scale, "radius"};
}

bool would_show_weights(const Workbench& bench) {
  const Look& look = bench.scene->look;
  const bool by_weight = look.surface_colour == ColourBy::weight ||
                         (look.surface_colour == ColourBy::file && look.bones);
  return by_weight && bench.scene->rig() != nullptr;
}

/// With its numbers.
float bar_height() {
  return ImGui::GetFontSize() + ImGui::GetStyle().ItemSpacing.y + ImGui::GetTextLineHeight();
}

void colour_bar(const Workbench& bench) {
  const auto shown = scale_shown(bench);
  if (!shown) {
    // So that nothing below moves when a joint is chosen.
    if (would_show_weights(bench)) ImGui::Dummy({1, bar_height()});
    return;
  }
  const auto& [scale, name] = *shown;
  const Look& look = bench.scene->look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ImGui::GetFontSize();
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const float share = static_cast<float>(i) / steps;
    const Rgba colour = rgba(mapped(look.map, share));
    ImGui::GetWindowDrawList()->AddRectFilled(
        {at.x + width * share, at.y}, {at.x + width * (share + 1.0F / steps) + 1, at.y + height},
        IM_COL32(colour[0], colour[1], colour[2], 255));
  }
  ImGui::Dummy({width, height});
  const std::string low = fmt::format("{:.4g}", scale.low);
  const std::string high = fmt::format("{:.4g}", scale.high);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(width / 2 - ImGui::GetFontSize() * 2);
  ImGui::TextUnformatted(name);
  ImGui::SameLine(width - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
}

}  // namespace

void draw_right_panel(Workbench& bench, Panels& panels, const Area& area) {
  if (!begin_panel("look", area)) return;
  draw_rig_section(bench, panels);
  if (ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) {
    look_controls(bench.scene->look, bench.scene->camera);
    tick("coarser while it moves", panels.may_be_coarse);
    tip("only where this machine cannot draw sixty whole pictures a second");
    colour_bar(bench);
  }
  if (ImGui::CollapsingHeader("Certificate", ImGuiTreeNodeFlags_DefaultOpen)) certificate(bench);
  const bool defective = bench.defects() != nullptr && !bench.defects()->none();
  if (defective && ImGui::CollapsingHeader("Input", ImGuiTreeNodeFlags_DefaultOpen)) {
    input_defects(bench);
  }
  if (ImGui::CollapsingHeader("Times")) times(bench);
  ImGui::End();
}

}  // namespace curveskel::viewer
