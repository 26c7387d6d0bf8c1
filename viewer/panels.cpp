#include "viewer/panels.hpp"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/certificate_table.hpp"

namespace curveskel::viewer {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                          ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus;

bool begin_panel(const char* name, const Area& area) {
  if (area.width <= 0 || area.height <= 0) return false;
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::Begin(name, nullptr, fixed_window);
  return true;
}

void tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  constexpr float widest = 24;  // of a letter's height
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * widest);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

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

/// A slider's label, a button back to the default where it is another, and whether a person has
/// just finished changing it.
template <typename Number>
bool finish_slider(const char* label, Number& value, Number standard, const char* meaning) {
  bool finished = ImGui::IsItemDeactivatedAfterEdit();
  tip(meaning);
  if (value == standard) return finished;
  ImGui::SameLine();
  ImGui::PushID(label);
  if (ImGui::SmallButton("x")) {
    value = standard;
    finished = true;
  }
  tip("back to the default");
  ImGui::PopID();
  return finished;
}

bool slide(const char* label, int& value, int standard, int least, int most, const char* meaning,
           ImGuiSliderFlags flags = 0) {
  ImGui::SliderInt(label, &value, least, most, "%d", flags | ImGuiSliderFlags_AlwaysClamp);
  return finish_slider(label, value, standard, meaning);
}

bool slide(const char* label, double& value, double standard, double least, double most,
           const char* meaning) {
  ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, "%.3g",
                      ImGuiSliderFlags_AlwaysClamp);
  return finish_slider(label, value, standard, meaning);
}

void run_buttons(Workbench& bench) {
  const bool active = bench.running() && bench.run_state() == Run::State::running;
  if (active) {
    if (ImGui::Button("Pause")) bench.pause();
  } else if (ImGui::Button(bench.running() ? "Go on" : "Run")) {
    bench.resume();
  }
  tip("Space");
  ImGui::SameLine();
  if (ImGui::Button("Step")) bench.step();
  tip("one moment on (Right)");
  ImGui::SameLine();
  if (ImGui::Button("Rewind")) bench.rewind();
  tip("to the input (Home)");
  ImGui::SameLine();
  ImGui::BeginDisabled(!bench.running());
  if (ImGui::Button("Cancel")) bench.cancel();
  ImGui::EndDisabled();
  tip("stop the run, keep what was recorded (Esc)");
}

void parameters(Workbench& bench) {
  const ExtractOptions standard;
  ExtractOptions& options = bench.pipeline.extract;
  bool changed = false;
  ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.48F);
  changed |= slide("fairing", options.fair.iterations, 0, 0, 50,
                   "Iterations of smoothing before anything else. For noisy scans; 0 = none.");
  changed |= slide("vertices", options.resolution, standard.resolution, 500, 60000,
                   "How many vertices the surface is coarsened to before it is contracted. More = "
                   "finer and slower.",
                   ImGuiSliderFlags_Logarithmic);
  changed |= slide("detail", options.embed.detail, standard.embed.detail, 0, 1,
                   "How small a branch may be and stay: 0 = only the main limbs, 1 = every bump "
                   "that makes one.");
  if (ImGui::TreeNode("More")) {
    ContractionOptions& flow = options.contraction;
    const ContractionOptions& usual = standard.contraction;
    changed |= slide("first weight", flow.contraction_weight, usual.contraction_weight, 0.1, 20,
                     "How strongly the first iteration contracts.");
    changed |= slide("growth", flow.contraction_growth, usual.contraction_growth, 1.05, 5,
                     "Factor on that weight from one iteration to the next. Small = slow and "
                     "careful.");
    changed |= slide("medial pull", flow.medial_weight, usual.medial_weight, 0, 10,
                     "How strongly vertices are drawn to the middle of the body.");
    changed |= slide("iterations", flow.max_iterations, usual.max_iterations, 1, 200,
                     "Of the contraction, at most.");
    changed |= slide("merge", options.embed.merge, standard.embed.merge, 0, 3,
                     "Junctions nearer to each other than so many inscribed radii become one.");
    changed |= slide("straight", options.embed.straight, standard.embed.straight, 0, 2,
                     "Within so many inscribed radii of a junction, branches run straight.");
    ImGui::TreePop();
  }
  ImGui::PopItemWidth();
  if (ImGui::Button("Defaults")) {
    const auto cache = options.contraction.program_cache;
    options = standard;
    options.fair.iterations = 0;
    options.contraction.program_cache = options.fair.program_cache = cache;
    changed = true;
  }
  tip("all parameters as they are without choosing any");
  if (changed && bench.scene->document.soup) bench.start(false);
}

void corrections(Workbench& bench) {
  const auto button = [&](const char* label, const char* meaning, auto action) {
    if (ImGui::Button(label)) action();
    tip(meaning);
  };
  button("Prune", "take out the leaf branch of the selected edge or tip (Delete)",
         [&] { bench.prune(); });
  ImGui::SameLine();
  button("Remove", "take out the selected node (Backspace)", [&] { bench.remove(); });
  ImGui::SameLine();
  button("Merge", "make one node of the two selected (M)", [&] { bench.merge(); });
  button("Cut", "take out the selected edge (C)", [&] { bench.cut(); });
  ImGui::SameLine();
  button("Join", "an edge between the two selected nodes (J)", [&] { bench.join(); });
  ImGui::SameLine();
  button("Split", "a node in the middle of the selected edge (N)", [&] { bench.split(); });
  ImGui::SameLine();
  button("Root", "the selected node is where the hierarchy begins (T)", [&] { bench.set_root(); });
  ImGui::BeginDisabled(!bench.history().can_undo());
  button("Undo", "Ctrl-Z", [&] { bench.undo(); });
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!bench.history().can_redo());
  button("Redo", "Ctrl-Y", [&] { bench.redo(); });
  ImGui::EndDisabled();
  if (bench.root() >= 0) {
    ImGui::SameLine();
    ImGui::Text("root: node %d", bench.root());
  }
}

void left_panel(Workbench& bench, Panels& panels, const Area& area) {
  if (!begin_panel("run", area)) return;
  if (ImGui::Button("Open")) panels.browser.ask(FileBrowser::Purpose::open, "");
  tip("Ctrl-O, or drop a file on the window");
  ImGui::SameLine();
  if (ImGui::Button("Save")) panels.browser.ask(FileBrowser::Purpose::save, "skeleton.json");
  tip("Ctrl-S; the format follows from the extension");
  ImGui::SameLine();
  if (ImGui::Button("Picture")) panels.wants_picture = true;
  tip("F12: a PNG beside the file that is open");
  ImGui::SameLine();
  if (ImGui::Button("Help")) panels.help = !panels.help;
  tip("H");
  ImGui::Separator();
  run_buttons(bench);
  if (bench.running()) {
    ImGui::ProgressBar(static_cast<float>(bench.news().fraction), {-1, 0},
                       bench.news().stage.c_str());
  } else {
    ImGui::ProgressBar(bench.result() != nullptr ? 1.0F : 0.0F, {-1, 0},
                       bench.result() != nullptr ? "done" : "");
  }
  if (ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) parameters(bench);
  if (ImGui::CollapsingHeader("Corrections", ImGuiTreeNodeFlags_DefaultOpen)) corrections(bench);
  if (!bench.measured().nodes.empty()) {
    ImGui::Text("path: %.6g units, %d edges", bench.measured().length,
                static_cast<int>(bench.measured().nodes.size()) - 1);
  } else if (bench.selected_nodes().size() == 2) {
    ImGui::TextUnformatted("no path between the two nodes");
  }
  ImGui::End();
}

void look_controls(Look& look, Camera& camera) {
  ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.52F);
  choose("surface", look.surface, surface_styles);
  choose("its colours", look.surface_colour, colourings);
  choose("skeleton", look.skeleton, skeleton_styles);
  choose("its colours ", look.skeleton_colour, colourings);
  choose("map", look.map, colour_maps);
  choose("theme", look.theme, themes);
  ImGui::SliderFloat("opacity", &look.opacity, 0, 1, "%.2f");
  tip("of the transparent surface");
  ImGui::SliderFloat("thickness", &look.thickness, 0.2F, 5, "%.2f", ImGuiSliderFlags_Logarithmic);
  tip("of tubes and lines");
  ImGui::PopItemWidth();
  ImGui::Checkbox("edges", &look.edges);
  ImGui::SameLine();
  ImGui::Checkbox("joints", &look.joints);
  ImGui::SameLine();
  ImGui::Checkbox("through", &look.through);
  tip("the skeleton shows through an opaque surface");
  ImGui::Checkbox("parallel projection", &camera.orthographic);
  tip("O");
}

/// Read against the panel of the theme: 4.5 to 1 at least.
ImVec4 verdict_colour(bool good, Theme theme) {
  if (theme == Theme::dark)
    return good ? ImVec4(0.40F, 0.80F, 0.52F, 1) : ImVec4(1, 0.48F, 0.43F, 1);
  return good ? ImVec4(0.04F, 0.42F, 0.17F, 1) : ImVec4(0.74F, 0.10F, 0.08F, 1);
}

void certificate_line(const char* name, const std::string& value, int verdict, Theme theme) {
  ImGui::TextUnformatted(name);
  ImGui::SameLine(ImGui::GetFontSize() * 6.5F);
  if (verdict < 0) {
    ImGui::TextUnformatted(value.c_str());
  } else {
    ImGui::TextColored(verdict_colour(verdict != 0, theme), "%s", value.c_str());
  }
}

void certificate(Workbench& bench) {
  const Judgement* found = bench.judgement();
  if (found == nullptr) {
    const bool alone = bench.scene->skeleton() && !bench.scene->document.soup;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped(alone ? "open the surface and the skeleton together to judge it"
                             : "not there yet");
    ImGui::PopStyleColor();
    return;
  }
  if (!found->error.empty()) {
    ImGui::TextWrapped("%s", found->error.c_str());
    return;
  }
  const Certificate& c = found->certificate;
  const auto line = [theme = bench.scene->look.theme](const char* name, const std::string& value,
                                                      int verdict) {
    certificate_line(name, value, verdict, theme);
  };
  const auto verdict = [](bool good) { return good ? 1 : 0; };
  line("components", fmt::format("{} of {}", c.components, c.components_of_surface),
       verdict(c.components == c.components_of_surface));
  line("cycles", fmt::format("{}, genus {}", c.cycle_rank, c.genus),
       verdict(c.cycle_rank == c.genus));
  line("inside", fmt::format("{:.2f} %", 100 * c.inside_fraction), verdict(c.inside_enough));
  if (!found->findings.exits.empty()) {
    ImGui::SameLine();
    if (ImGui::SmallButton("show##exits")) bench.show_exits();
    tip("the edges that leave the surface");
  }
  line("spurs", fmt::format("{}", c.spurs), verdict(c.spurs == 0));
  if (c.spurs > 0) {
    ImGui::SameLine();
    if (ImGui::SmallButton("show##spurs")) bench.show_spurs();
  }
  line("deepest exit", fmt::format("{:.2g} D", c.deepest_exit), -1);
  line("centredness", fmt::format("{:.3f}, p90 {:.3f}", c.centredness_median, c.centredness_p90),
       -1);
  line("coverage", fmt::format("{:.1f} %", 100 * c.coverage), -1);
  line("reach", fmt::format("{:.4f} D", c.reach), -1);
  line("tips", fmt::format("{}", c.tips), -1);
  line("junctions", fmt::format("{}", c.junctions), -1);
  line("length", fmt::format("{:.3f} D", c.length), -1);
  line("turning", fmt::format("{:.1f} rad/D", c.turning), -1);
}

/// What had to be repaired, or could not be.
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
  line("open", found.open, "with an edge that no other face has: at a hole or a rim");
  line("non-manifold", found.non_manifold, "with an edge that three faces or more have");
  line("flipped", found.flipped, "facing the other way than a neighbour");
  line("degenerate", found.degenerate, "with a corner twice, or no area");
}

void colour_bar(const Workbench& bench) {
  const Look& look = bench.scene->look;
  const bool by_radius =
      look.surface_colour == ColourBy::radius || look.skeleton_colour == ColourBy::radius;
  const auto skeleton = bench.scene->skeleton();
  if (!by_radius || !skeleton) return;
  const auto scale = radius_scale(*skeleton);
  if (!scale) return;
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
  const std::string low = fmt::format("{:.4g}", scale->low);
  const std::string high = fmt::format("{:.4g}", scale->high);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(width / 2 - ImGui::GetFontSize() * 2);
  ImGui::TextUnformatted("radius");
  ImGui::SameLine(width - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
}

void right_panel(Workbench& bench, const Area& area) {
  if (!begin_panel("look", area)) return;
  if (ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) {
    look_controls(bench.scene->look, bench.scene->camera);
    colour_bar(bench);
  }
  if (ImGui::CollapsingHeader("Certificate", ImGuiTreeNodeFlags_DefaultOpen)) certificate(bench);
  const bool defective = bench.defects() != nullptr && !bench.defects()->none();
  if (defective && ImGui::CollapsingHeader("Input", ImGuiTreeNodeFlags_DefaultOpen)) {
    input_defects(bench);
  }
  ImGui::End();
}

/// As many of the facts as fit, the first ones first.
void status_bar(const Workbench& bench, const Panels& panels, const Area& area) {
  if (!begin_panel("status", area)) return;
  const Document& document = bench.scene->document;
  std::vector<std::string> facts;
  if (document.soup) {
    facts.push_back(
        fmt::format("{}: {} vertices, {} triangles", document.mesh_file.filename().string(),
                    document.surface.positions.rows(), document.surface.triangles.rows()));
  }
  if (const auto skeleton = bench.scene->skeleton()) {
    facts.push_back(
        fmt::format("{} nodes, {} edges", skeleton->nodes.rows(), skeleton->edges.rows()));
  }
  facts.push_back(title_of(bench.scene->recording.moments()[bench.scene->moment]));
  facts.push_back(fmt::format("{:.1f} ms, 99 % below {:.1f}", panels.times.last(),
                              panels.times.percentile(0.99)));
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

void messages(const Workbench& bench, const Area& picture) {
  const auto now = std::chrono::steady_clock::now();
  float y = picture.y + 10;
  for (const Message& message : bench.messages()) {
    const double shown_seconds = message.bad ? 12 : 4;
    const double age = std::chrono::duration<double>(now - message.since).count();
    if (age > shown_seconds) continue;
    const float widest = picture.width - 40;
    const ImVec2 size = ImGui::CalcTextSize(message.text.c_str(), nullptr, false, widest);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const ImU32 back = message.bad ? IM_COL32(170, 35, 30, 235) : IM_COL32(40, 46, 54, 215);
    const ImVec2 low(picture.x + 12, y);
    list.AddRectFilled(low, {low.x + size.x + 16, low.y + size.y + 10}, back, 5);
    list.AddText(nullptr, 0, {low.x + 8, low.y + 5}, IM_COL32(255, 255, 255, 255),
                 message.text.c_str(), nullptr, widest);
    y += size.y + 14;
  }
}

void help(Panels& panels) {
  if (!panels.help) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, screen);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse |
                                     ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Help", &panels.help, flags)) {
    constexpr std::array<std::array<const char*, 2>, 17> lines{{
        {"drag", "turn (left), move (middle, or Shift + left), nearer (right, or the wheel)"},
        {"double click, F", "fly to what is under the pointer; fit everything"},
        {"1 3 7, with Ctrl 9", "front, right, top, and from the other side"},
        {"0, O", "the best view, parallel projection"},
        {"click, Shift + click",
         "select a node, an edge, or the part of the surface of a node; "
         "two nodes: the path between"},
        {"Ctrl + drag", "move a node"},
        {"Delete, Backspace", "prune the branch, remove the node"},
        {"M  C  J  N  T", "merge, cut, join, put a node on an edge, set the root"},
        {"Ctrl-Z, Ctrl-Y", "take back, do again"},
        {"Space, Left, Right", "run or pause, one moment back or on"},
        {"Home, End", "the input, the newest"},
        {"S  E  K", "how the surface is drawn, its edges, how the skeleton is drawn"},
        {"L, B", "light or dark, transparent background"},
        {"Ctrl-O, Ctrl-S, R", "open, save, read again"},
        {"F12", "a picture"},
        {"Tab, H", "panels on and off, this help"},
        {"Esc, Ctrl-Q", "cancel or clear the selection, leave"},
    }};
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const auto& [keys, meaning] : lines) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(meaning);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void browser(Workbench& bench, Panels& panels) {
  const auto chosen = panels.browser.draw();
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
  text += fmt::format("\n{} edge{}", degree, degree == 1 ? "" : "s");
  const auto vertices = (skeleton.node_of_vertex.array() == node).count();
  if (skeleton.node_of_vertex.size() > 0) text += fmt::format("\n{} vertices", vertices);
  return text;
}

}  // namespace

Layout lay_out(float width, float height, float scale, bool panels) {
  Layout layout;
  const float line = 26 * scale;
  layout.status = {0, height - line, width, line};
  layout.picture = {0, 0, width, height - line};
  if (!panels) return layout;
  const float side = std::min(290 * scale, width * 0.30F);
  const float timeline = std::min(130 * scale, height * 0.2F);
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

void draw_panels(Workbench& bench, Panels& panels, const Layout& layout) {
  left_panel(bench, panels, layout.left);
  right_panel(bench, layout.right);
  draw_timeline(bench, layout.timeline);
  status_bar(bench, panels, layout.status);
  messages(bench, layout.picture);
  help(panels);
  browser(bench, panels);
  const std::string hovered = description_of(panels.hovered, bench);
  if (!hovered.empty() && !ImGui::GetIO().WantCaptureMouse) {
    ImGui::SetTooltip("%s", hovered.c_str());
  }
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
  style.Colors[ImGuiCol_WindowBg] = {palette.lower.r, palette.lower.g, palette.lower.b, 1};
  style.ScaleAllSizes(scale);
}

}  // namespace curveskel::viewer
