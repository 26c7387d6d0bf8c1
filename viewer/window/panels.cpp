#include "viewer/window/panels.hpp"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/counted.hpp"
#include "viewer/window/panel_keys.hpp"
#include "viewer/window/panel_parts.hpp"
#include "viewer/window/reading_order.hpp"

namespace curveskel::viewer {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                          ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus;

void glance_at(const Workbench& bench, Panels& panels) {
  constexpr std::chrono::milliseconds often(250);
  const auto now = std::chrono::steady_clock::now();
  if (now - panels.glance.since < often) return;
  panels.glance = {panels.times.last(), panels.times.percentile(0.99), bench.news().fraction, now};
}

/// As many of the facts as fit, the first ones first.
void status_bar(const Workbench& bench, const Panels& panels, const Area& area) {
  if (!begin_panel("status", area)) return;
  const Document& document = bench.scene->document;
  std::vector<std::string> facts;
  if (document.has_surface()) {
    facts.push_back(in_reading_order(document.mesh_file.filename().string()));
    facts.push_back(fmt::format("{}, {}",
                                count_of(document.surface.positions.rows(), "vertex", "vertices"),
                                count_of(document.surface.triangles.rows(), "triangle")));
  }
  if (const auto skeleton = bench.scene->skeleton()) {
    facts.push_back(fmt::format("{}, {}", count_of(skeleton->nodes.rows(), "node"),
                                count_of(skeleton->edges.rows(), "edge")));
  }
  if (panels.coarse) facts.emplace_back("drawing coarsely while it moves");
  facts.push_back(title_of(bench.scene->recording.moments()[bench.scene->moment]));
  facts.push_back(fmt::format("{:.1f} ms, 99 % below {:.1f}", panels.glance.last_milliseconds,
                              panels.glance.slow_milliseconds));
  facts.push_back(panels.gl);
  facts.push_back(panels.transfer);
  std::string line;
  for (const std::string& fact : facts) {
    const std::string longer = line.empty() ? fact : fmt::format("{}   |   {}", line, fact);
    const bool fits = ImGui::CalcTextSize(longer.c_str()).x <= ImGui::GetContentRegionAvail().x;
    if (!fits && !line.empty()) break;
    line = longer;
  }
  ImGui::TextUnformatted(line.c_str());
  ImGui::End();
}

/// A message that is still to be read.
struct Notice {
  std::string text;
  bool bad = false;
  ImVec2 size;
};

/// The newest ones, as many as leave some of the picture to be seen, one at least. Those before can
/// be read in the panel.
std::vector<Notice> notices(const Workbench& bench, float widest, float highest, float between) {
  const auto now = std::chrono::steady_clock::now();
  std::vector<Notice> shown;
  float height = 0;
  const std::deque<Message>& all = bench.messages();
  for (std::size_t i = all.size(); i-- > 0;) {
    const Message& message = all[i];
    // As long as it takes to read.
    const double letters = static_cast<double>(message.text.size());
    const double shown_seconds = std::max(message.bad ? 12.0 : 4.0, letters / 15);
    const double age = std::chrono::duration<double>(now - message.since).count();
    if (age > shown_seconds) continue;
    Notice one{in_reading_order(message.text), message.bad, {}};
    one.size = ImGui::CalcTextSize(one.text.c_str(), nullptr, false, widest);
    height += one.size.y + between;
    if (!shown.empty() && height > highest) break;
    shown.push_back(std::move(one));
  }
  std::reverse(shown.begin(), shown.end());
  return shown;
}

void messages(const Workbench& bench, const Area& picture, float scale) {
  const float widest = picture.width - 40 * scale;
  const float between = 14 * scale;
  float y = picture.y + 10 * scale;
  // A dialogue is not covered.
  ImDrawList& list =
      is_list_open() ? *ImGui::GetBackgroundDrawList() : *ImGui::GetForegroundDrawList();
  for (const Notice& one : notices(bench, widest, picture.height * 0.6F, between)) {
    const ImU32 back = one.bad ? IM_COL32(170, 35, 30, 235) : IM_COL32(40, 46, 54, 215);
    const ImVec2 low(picture.x + 12 * scale, y);
    list.AddRectFilled(low, {low.x + one.size.x + 16 * scale, low.y + one.size.y + 10 * scale},
                       back, 5 * scale);
    list.AddText(nullptr, 0, {low.x + 8 * scale, low.y + 5 * scale}, IM_COL32(255, 255, 255, 255),
                 one.text.c_str(), nullptr, widest);
    y += one.size.y + between;
  }
}

/// The second column is wrapped where the window is narrow, and below the first where that leaves
/// it no room.
template <std::size_t Count>
void help_lines(const std::array<std::array<const char*, 2>, Count>& lines, float screen) {
  float keys_width = 0;
  float widest = 0;
  for (const auto& [keys, meaning] : lines) {
    keys_width = std::max(keys_width, ImGui::CalcTextSize(keys).x);
    widest = std::max(widest, ImGui::CalcTextSize(meaning).x);
  }
  const float margin = 4 * ImGui::GetFontSize();
  const float room = screen - keys_width - margin;
  if (room < 8 * ImGui::GetFontSize()) {
    ImGui::PushTextWrapPos(screen - margin);
    for (const auto& [keys, meaning] : lines) {
      ImGui::TextUnformatted(keys);
      ImGui::Indent();
      ImGui::TextUnformatted(meaning);
      ImGui::Unindent();
    }
    ImGui::PopTextWrapPos();
    return;
  }
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (const auto& [keys, meaning] : lines) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + std::min(widest + 1, room));
    ImGui::TextUnformatted(meaning);
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
}

void help(Panels& panels) {
  if (!panels.help) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  // It cannot be moved where it fills the window.
  const float letter = ImGui::GetFontSize();
  const bool fills = screen.x < 50 * letter || screen.y < 36 * letter;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2},
                          fills ? ImGuiCond_Always : ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, screen);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse |
                                     ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Help", &panels.help, flags)) {
    constexpr std::array<std::array<const char*, 2>, 21> lines{{
        {"drag", "turn (left), move (middle, or Shift + left), nearer (right, or the wheel)"},
        {"double click, F", "fly to what is under the pointer; fit everything"},
        {"1 3 7 9", "front, right, top, back; with Ctrl from the other side"},
        {"0, O", "the best view, parallel projection"},
        {"click, Shift + click",
         "select a node, an edge, or the part of the surface of a node; "
         "two nodes: the path between"},
        {"Ctrl + drag", "move a node; of a rig: turn the bone that ends in a joint, to look at it"},
        {"Delete, Backspace", "prune the branch, remove the node"},
        {"M  C  J  N  T", "merge, cut, join, put a node on an edge, set the root"},
        {"G", "joints and skin weights for the skeleton as it is"},
        {"Ctrl-Z, Ctrl-Y", "take back, do again"},
        {"Space, Left, Right", "run or pause, one moment back or on"},
        {"Home, End", "the input, the newest"},
        {"S  E  K", "how the surface is drawn, its edges, how the skeleton is drawn"},
        {"L, B", "light or dark, pictures without background"},
        {"Ctrl-O, Ctrl-S, R", "open, save, read again"},
        {"F12", "a picture"},
        {"Ctrl + click on a slider", "type a number"},
        {"P, H", "panels on and off, this help"},
        {"Tab, Shift + Tab", "into the panels, and from control to control"},
        {"there: arrows, Space, Enter",
         "move, press or change with the arrows, type a number; Esc leads back to the picture"},
        {"Esc, Ctrl-Q", "cancel what goes on or clear the selection, leave"},
    }};
    help_lines(lines, screen.x);
  }
  ImGui::End();
}

/// In an empty window: the ways to fill it. While files are opened: how far that is.
void hint(const Workbench& bench, const Area& picture) {
  const Document& document = bench.scene->document;
  const StageNews::Stage stage = bench.opening_stage();
  if ((document.has_surface() || document.skeleton) && !bench.opening()) return;
  const std::string text =
      bench.opening()
          ? fmt::format("opening: {} {:.0f} %\nEsc cancels.", stage.name, 100 * stage.fraction)
          : "Drop a surface, a skeleton or a rig here,\nor press Ctrl-O to open one; H "
            "for help.";
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  if (size.x > picture.width || size.y > picture.height) return;
  ImGui::GetBackgroundDrawList()->AddText({picture.x + std::floor((picture.width - size.x) / 2),
                                           picture.y + std::floor((picture.height - size.y) / 2)},
                                          ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str());
}

void description_at_pointer(const Workbench& bench, const Panels& panels) {
  const std::string hovered = description_of(panels.hovered, bench);
  if (hovered.empty() || ImGui::GetIO().WantCaptureMouse) return;
  ImGui::SetTooltip("%s", hovered.c_str());
}

std::string missing_of(const VrmMeta& meta) {
  if (meta.name.empty() || meta.author.empty() || meta.licence_url.empty()) {
    return "a .vrm file needs the name of its figure, an author and a licence: fill in the fields "
           "below";
  }
  try {
    require_whole(meta);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// VRM's files must have these.
FieldsForName vrm_fields(VrmMeta& meta, FieldText& texts) {
  const auto draw = [&meta, &texts](bool focuses) {
    const auto field = [&focuses, &texts](const char* label, const char* hint, std::string& text,
                                          bool lacks) {
      if (lacks && std::exchange(focuses, false)) ImGui::SetKeyboardFocusHere();
      ImGui::SetNextItemWidth(-5 * ImGui::GetFontSize());
      std::string shown = texts.in_field(text);
      const bool entered =
          ImGui::InputTextWithHint(label, hint, &shown, ImGuiInputTextFlags_EnterReturnsTrue);
      text = texts.from_field(shown);
      return entered;
    };
    const bool first = field("figure", "its name", meta.name, meta.name.empty());
    const bool second = field("author", "who made the figure", meta.author, meta.author.empty());
    return field("licence", "https://vrm.dev/licenses/1.0/", meta.licence_url, true) || first ||
           second;
  };
  return {"vrm", 3, draw, [&meta] { return missing_of(meta); }};
}

void browser(Workbench& bench, Panels& panels) {
  const auto chosen = panels.browser.draw(vrm_fields(bench.vrm, panels.vrm_texts));
  if (!chosen) return;
  if (panels.browser.purpose() == FileBrowser::Purpose::open) {
    bench.open({*chosen});
  } else {
    bench.save(*chosen);
  }
}

std::string description_of_node(int node, const CurveSkeleton& skeleton) {
  std::string text = fmt::format("node {}\n({:.5g}, {:.5g}, {:.5g})", node, skeleton.nodes(node, 0),
                                 skeleton.nodes(node, 1), skeleton.nodes(node, 2));
  if (skeleton.radii.size() > 0) text += fmt::format("\nradius {:.5g}", skeleton.radii[node]);
  const auto degree = (skeleton.edges.array() == node).count();
  text += "\n" + count_of(degree, "edge");
  const auto vertices = (skeleton.node_of_vertex.array() == node).count();
  if (skeleton.node_of_vertex.size() > 0) {
    text += "\n" + count_of(vertices, "vertex", "vertices");
  }
  return text;
}

std::string description_of_joint(int joint, const Rig& rig) {
  const auto name_of = [&](int index) {
    const std::string& name = rig.names[static_cast<std::size_t>(index)];
    return name.empty() ? fmt::format("joint {}", index) : in_reading_order(name);
  };
  std::string text = fmt::format("{}\n({:.5g}, {:.5g}, {:.5g})", name_of(joint),
                                 rig.joints(joint, 0), rig.joints(joint, 1), rig.joints(joint, 2));
  const int parent = rig.parents[joint];
  text += parent < 0 ? "\na root" : fmt::format("\nbelow {}", name_of(parent));
  const auto moved = (rig.weights.col(joint).toDense().array() > 0).count();
  return text + "\nmoves " + count_of(moved, "vertex", "vertices");
}

}  // namespace

void ask_to_open(Panels& panels) {
  panels.browser.ask(FileBrowser::Purpose::open, "Open a surface or a skeleton", "",
                     "Surfaces: " + names_in(surface_formats) +
                         ", vrm, also as .gz. Skeletons: obj, ply, cgal, swc, vtp, graphml, json.");
}

void ask_to_save(const Workbench& bench, Panels& panels) {
  panels.browser.ask(FileBrowser::Purpose::save,
                     bench.shows_made_rig() ? "Save the rig" : "Save the skeleton",
                     bench.suggested_name(),
                     "The extension chooses the format. Skeletons and their pictures: " +
                         names_in(skeleton_formats) + ". Rigs: " + names_in(rig_formats) + ".");
}

Area whole_pixels(const Area& area) {
  const float x = std::floor(area.x);
  const float y = std::floor(area.y);
  return {x, y, std::ceil(area.x + area.width) - x, std::ceil(area.y + area.height) - y};
}

bool begin_panel(const char* name, const Area& area) {
  if (area.width <= 0 || area.height <= 0) return false;
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::Begin(name, nullptr, fixed_window);
  return true;
}

void tip(const char* text) {
  if (text[0] == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  constexpr float widest = 24;  // of a letter's height
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * widest);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void beside_if_it_fits(const char* label) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = ImGui::CalcTextSize(label, nullptr, true).x + 2 * style.FramePadding.x;
  const float right = ImGui::GetItemRectMax().x + style.ItemSpacing.x + width;
  if (right <= ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
}

void box_beside_if_it_fits(const char* label) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x +
                      ImGui::CalcTextSize(label, nullptr, true).x;
  const float right = ImGui::GetItemRectMax().x + style.ItemSpacing.x + width;
  if (right <= ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
}

std::string place_control(const char* label, float share) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room = ImGui::GetContentRegionAvail().x;
  const float button = ImGui::CalcTextSize("x").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
  const float words = ImGui::CalcTextSize(label, nullptr, true).x;
  if (room * share + style.ItemInnerSpacing.x + words + button <= room) {
    ImGui::SetNextItemWidth(room * share);
    return label;
  }
  ImGui::TextWrapped("%s", label);
  ImGui::SetNextItemWidth(room - button);
  return std::string("##") + label;
}

bool tick(const char* label, bool& value) {
  const float box = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
  const float words = ImGui::CalcTextSize(label, nullptr, true).x;
  if (box + words <= ImGui::GetContentRegionAvail().x) return ImGui::Checkbox(label, &value);
  ImGui::BeginGroup();
  bool changed = ImGui::Checkbox((std::string("##") + label).c_str(), &value);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::TextWrapped("%s", label);
  if (ImGui::IsItemClicked()) {
    value = !value;
    changed = true;
  }
  ImGui::EndGroup();
  return changed;
}

bool list_line(const char* label, bool present) {
  const bool chosen = ImGui::Selectable(label, present);
  if (present && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
  if (present) ImGui::SetItemDefaultFocus();
  return chosen;
}

ImVec4 verdict_colour(bool good, Theme theme) {
  if (theme == Theme::dark)
    return good ? ImVec4(0.40F, 0.80F, 0.52F, 1) : ImVec4(1, 0.48F, 0.43F, 1);
  return good ? ImVec4(0.04F, 0.42F, 0.17F, 1) : ImVec4(0.74F, 0.10F, 0.08F, 1);
}

void close_by_escape() {
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
}

Layout lay_out(float width, float height, float scale, bool panels) {
  // Of whole pixels, so that there is nothing between the parts.
  Layout layout;
  const float line = std::floor(26 * scale);
  layout.status = {0, height - line, width, line};
  layout.picture = {0, 0, width, height - line};
  if (!panels) return layout;
  const float timeline = std::floor(std::min(130 * scale, height * 0.2F));
  constexpr float narrow = 560;  // too little for two panels beside a picture
  if (width < narrow * scale && width < height) {
    const float half = std::floor(width / 2);
    const float panel = std::floor(height * 0.42F);
    const float below = height - line - panel;
    layout.left = {0, below, half, panel};
    layout.right = {half, below, width - half, panel};
    layout.timeline = {0, below - timeline, width, timeline};
    layout.picture = {0, 0, width, below - timeline};
    return layout;
  }
  const float side = std::floor(std::min(290 * scale, width * 0.30F));
  layout.left = {0, 0, side, height - line};
  layout.right = {width - side, 0, side, height - line};
  layout.timeline = {side, height - line - timeline, width - 2 * side, timeline};
  layout.picture = {side, 0, width - 2 * side, height - line - timeline};
  return layout;
}

std::string description_of(const Pick& picked, const Workbench& bench) {
  const auto skeleton = bench.scene->skeleton();
  const Surface& surface = bench.scene->document.surface;
  switch (picked.kind) {
    case Pick::Kind::nothing:
      break;
    case Pick::Kind::joint: {
      const auto rig = bench.scene->rig();
      if (!rig || picked.index >= rig->joints.rows()) break;
      return description_of_joint(picked.index, *rig);
    }
    case Pick::Kind::node:
      if (!skeleton || picked.index >= skeleton->nodes.rows()) break;
      return description_of_node(picked.index, *skeleton);
    case Pick::Kind::edge: {
      if (!skeleton || picked.index >= skeleton->edges.rows()) break;
      const int a = skeleton->edges(picked.index, 0);
      const int b = skeleton->edges(picked.index, 1);
      return fmt::format("edge {}: nodes {} and {}\nlength {:.5g}", picked.index, a, b,
                         (skeleton->nodes.row(a) - skeleton->nodes.row(b)).norm());
    }
    case Pick::Kind::face: {
      std::string text =
          fmt::format("triangle {}\nvertex {}: ({:.5g}, {:.5g}, {:.5g})", picked.index,
                      picked.vertex, surface.positions(picked.vertex, 0),
                      surface.positions(picked.vertex, 1), surface.positions(picked.vertex, 2));
      if (skeleton && skeleton->node_of_vertex.size() == surface.positions.rows()) {
        text += fmt::format("\nnode {}", skeleton->node_of_vertex[picked.vertex]);
      }
      return text;
    }
  }
  return {};
}

void for_each_name(const Workbench& bench, const Panels& panels,
                   const std::function<void(const std::string&)>& visit) {
  for (const std::filesystem::path& file : bench.files()) visit(file.string());
  for (const Message& message : bench.messages()) visit(message.text);
  panels.browser.for_each_name(visit);
  for (const std::string& text : {bench.vrm.name, bench.vrm.author}) visit(text);
  if (const auto rig = bench.scene->rig()) {
    for (const std::string& name : rig->names) visit(name);
  }
}

void draw_panels(Workbench& bench, Panels& panels, const Layout& layout) {
  glance_at(bench, panels);
  draw_left_panel(bench, panels, layout.left);
  draw_right_panel(bench, panels, layout.right);
  draw_timeline(bench, layout.timeline);
  status_bar(bench, panels, layout.status);
  messages(bench, layout.picture, panels.scale);
  hint(bench, layout.picture);
  // Dialogues come last: in the frame in which one appears, ImGui 1.86 aborts where another window
  // appears after it.
  description_at_pointer(bench, panels);
  help(panels);
  browser(bench, panels);
  questions(bench, panels);
}

void style_panels(Theme theme, float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  if (theme == Theme::dark) {
    ImGui::StyleColorsDark();
  } else {
    ImGui::StyleColorsLight();
  }
  style.WindowRounding = 0;
  style.WindowBorderSize = 1;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowPadding = {10, 8};
  style.FrameBorderSize = theme == Theme::light ? 1.0F : 0.0F;
  const Palette palette = palette_of(theme);
  // Numbers stay legible under the sliders' grips and on the progress bar.
  style.Colors[ImGuiCol_SliderGrab].w = style.Colors[ImGuiCol_SliderGrabActive].w = 0.45F;
  style.Colors[ImGuiCol_PlotHistogram] =
      theme == Theme::dark ? ImVec4(0.16F, 0.44F, 0.36F, 1) : ImVec4(0.58F, 0.83F, 0.75F, 1);
  style.Colors[ImGuiCol_TextDisabled] =
      theme == Theme::dark ? ImVec4(0.60F, 0.62F, 0.65F, 1) : ImVec4(0.38F, 0.40F, 0.43F, 1);
  style.Colors[ImGuiCol_WindowBg] = {palette.lower.r, palette.lower.g, palette.lower.b, 1};
  style.ScaleAllSizes(scale);
}

}  // namespace curveskel::viewer
