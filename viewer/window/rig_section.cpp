// The rig's section of the right panel: the chosen joint, and all joints by their order.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/rigging.hpp"
#include "viewer/window/panel_keys.hpp"
#include "viewer/window/panel_parts.hpp"
#include "viewer/window/reading_order.hpp"

namespace curveskel::viewer {
namespace {

/// True when its arrow was clicked.
bool joint_line(Workbench& bench, const Rig& rig, const HierarchyLine& line, bool open) {
  const auto joint = static_cast<std::size_t>(line.joint);
  const bool leaf = line.below == 0;
  const ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen |
      ImGuiTreeNodeFlags_SpanAvailWidth | (leaf ? ImGuiTreeNodeFlags_Leaf : 0) |
      (line.joint == bench.selected_joint() ? ImGuiTreeNodeFlags_Selected : 0);
  ImGui::PushID(line.joint);
  ImGui::SetNextItemOpen(open);
  const std::string name = in_reading_order(rig.names[joint]);
  ImGui::TreeNodeEx("joint", flags, "%s", name.empty() ? "?" : name.c_str());
  ImGui::PopID();
  const float right =
      ImGui::GetItemRectMin().x + 2 * ImGui::GetFontSize() + ImGui::CalcTextSize(name.c_str()).x;
  const bool is_cut = right > ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (is_cut) tip(name.c_str());
  const bool by_key = is_pressed_by_key();  // which folds nothing, unlike Left and Right
  if (ImGui::IsItemToggledOpen() && !by_key) return true;
  if (ImGui::IsItemClicked() || by_key) {
    bench.select_joint(line.joint == bench.selected_joint() ? -1 : line.joint);
  }
  return false;
}

/// Degrees about x, then y, then z; none is shown as "-0.0".
std::array<float, 3> angles_of_turn(const Eigen::Quaterniond& turn) {
  const Eigen::Matrix3d r = turn.toRotationMatrix();
  const double y = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const auto degrees = [](double angle) {
    constexpr double least = 0.05;
    const double found = angle * 180 / std::numbers::pi;
    return std::abs(found) < least ? 0.0F : static_cast<float>(found);
  };
  return {degrees(std::atan2(r(2, 1), r(2, 2))), degrees(y), degrees(std::atan2(r(1, 0), r(0, 0)))};
}

Eigen::Quaterniond turn_of(const Workbench& bench, int joint) {
  const auto turns = bench.scene->turns();
  const bool is_turned = turns && joint >= 0 && static_cast<std::size_t>(joint) < turns->size();
  return is_turned ? (*turns)[static_cast<std::size_t>(joint)] : Eigen::Quaterniond::Identity();
}

constexpr float turn_share = 0.7F;  // of the panel's width

/// `joint` may be none. Half a degree for a pixel, as a slider of this width would be too coarse.
void turn_controls(Workbench& bench, TurnAngles& kept, int joint) {
  std::array<float, 3> angles = angles_of(kept, bench, joint);
  const bool is_beside = place_control("turn", turn_share) == "turn";
  const float whole = ImGui::CalcItemWidth();
  constexpr std::array<const char*, 3> names{"##x", "##y", "##z"};
  constexpr std::array<float, 3> most{180, 90, 180};  // all turns, each once
  bool changed = false;
  bool begins = false;
  ImGui::BeginGroup();
  const float between = ImGui::GetStyle().ItemInnerSpacing.x;
  const float wide = std::floor((whole - 2 * between) / 3);
  for (std::size_t axis = 0; axis < angles.size(); ++axis) {
    if (axis > 0) ImGui::SameLine(0, between);
    ImGui::SetNextItemWidth(wide);
    changed = ImGui::DragFloat(names[axis], &angles[axis], 0.5F, -most[axis], most[axis], "%.1f",
                               ImGuiSliderFlags_AlwaysClamp) ||
              changed;
    begins = ImGui::IsItemActivated() || begins;
  }
  if (is_beside) {
    ImGui::SameLine(0, between);
    ImGui::TextUnformatted("turn");
  }
  ImGui::EndGroup();
  tip("degrees about x, y, z: drag, or double-click to type; Ctrl + drag of a joint does the same "
      "by hand");
  if (begins) bench.begin_turning();
  if (changed) set_angles(kept, bench, joint, angles);
}

/// The role of the chosen joint, to be corrected.
void role_choice(Workbench& bench, const CharacterRig& character, int joint) {
  const auto& roles = character.rig.roles;
  const auto at = static_cast<std::size_t>(joint);
  const std::string now = joint >= 0 && at < roles.size() ? roles[at] : "";
  const std::vector<std::string> all = roles_of(character.plan.plan);
  if (all.empty()) return;
  const std::string name = place_control("role", turn_share);
  const bool open = ImGui::BeginCombo(name.c_str(), now.empty() ? "none" : now.c_str());
  if (!open)
    tip("what the joint is, such as the left upper arm; another choice corrects it (Ctrl-Z "
        "takes it back)");
  if (!open) return;
  std::optional<std::string> chosen;
  if (list_line("none", now.empty())) chosen = "";
  for (const std::string& role : all) {
    if (list_line(role.c_str(), role == now)) chosen = role;
  }
  close_by_escape();
  ImGui::EndCombo();
  if (chosen && *chosen != now) bench.set_role(*chosen);
}

/// Of the same height whether one is chosen or not, so that the list below stays under the pointer.
void chosen_joint(Workbench& bench, TurnAngles& angles, const Rig& rig) {
  const bool is_chosen = bench.selected_joint() >= 0 && bench.selected_joint() < rig.joints.rows();
  const int joint = is_chosen ? bench.selected_joint() : -1;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", is_chosen ? "the chosen joint:" : "click a joint to turn or correct it");
  ImGui::PopStyleColor();
  ImGui::BeginDisabled(!is_chosen);
  if (const auto character = bench.scene->character()) role_choice(bench, *character, joint);
  turn_controls(bench, angles, joint);
  ImGui::EndDisabled();
  ImGui::BeginDisabled(!bench.scene->turns());
  if (ImGui::Button("Turn all back")) bench.turn_back();
  ImGui::EndDisabled();
  tip("to the pose of the file");
}

/// Makes the line of a joint seen that was chosen elsewhere: in the picture, or by a key.
void scroll_to_chosen(const Workbench& bench, const Outline& outline, int& listed) {
  const int joint = bench.selected_joint();
  if (std::exchange(listed, joint) == joint) return;
  const std::vector<HierarchyLine>& seen = outline.seen();
  const auto at = std::find_if(seen.begin(), seen.end(),
                               [&](const HierarchyLine& line) { return line.joint == joint; });
  if (at == seen.end()) return;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float place = line * static_cast<float>(at - seen.begin());
  const float from = ImGui::GetScrollY();
  const float high = ImGui::GetWindowHeight() - 2 * ImGui::GetStyle().WindowPadding.y;
  if (place >= from && place + line <= from + high) return;
  ImGui::SetScrollY(std::max(place - high / 2, 0.0F));
}

/// As wide as leaves room for each name, but never so little that the order is not seen.
float step_of(const Outline& outline, const Rig& rig, float room) {
  const float letter = ImGui::GetFontSize();
  float step = letter * 0.5F;
  for (const HierarchyLine& line : outline.seen()) {
    if (line.depth == 0) continue;
    const std::string& name = rig.names[static_cast<std::size_t>(line.joint)];
    const float left = room - 2 * letter - ImGui::CalcTextSize(name.c_str()).x;
    step = std::min(step, std::max(left, 0.0F) / static_cast<float>(line.depth));
  }
  return std::max(step, letter * 0.15F);
}

/// Only the lines within the panel are laid out.
void hierarchy(Workbench& bench, Panels& panels, const Rig& rig) {
  Outline& outline = panels.outline;
  const float room = ImGui::GetContentRegionAvail().x;
  const std::size_t lines = outline.seen().size();
  const int glyphs = ImGui::GetFont()->Glyphs.Size;
  Indentation& now = panels.indentation;
  if (now.room != room || now.lines != lines || now.glyphs != glyphs) {
    now = {step_of(outline, rig, room), room, lines, glyphs};
  }
  int folded = -1;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(outline.seen().size()));
  while (clipper.Step()) {
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const HierarchyLine& line = outline.seen()[static_cast<std::size_t>(row)];
      ImGui::SetCursorPosX(ImGui::GetCursorPosX() + now.step * static_cast<float>(line.depth));
      if (joint_line(bench, rig, line, !outline.folded(line.joint))) folded = line.joint;
    }
  }
  if (folded >= 0) outline.fold(folded);
}

}  // namespace

const std::array<float, 3>& angles_of(TurnAngles& kept, const Workbench& bench, int joint) {
  const Eigen::Quaterniond now = turn_of(bench, joint);
  const bool are_its = kept.rig == bench.scene->rig() && kept.joint == joint &&
                       kept.turn.coeffs().isApprox(now.coeffs());
  if (!are_its) kept = {bench.scene->rig(), joint, now, angles_of_turn(now)};
  return kept.degrees;
}

void set_angles(TurnAngles& kept, Workbench& bench, int joint,
                const std::array<float, 3>& degrees) {
  std::array<double, 3> exact{};
  std::copy(degrees.begin(), degrees.end(), exact.begin());
  bench.turn_joint(joint, turn_by(exact) * turn_of(bench, joint).conjugate());
  kept = {bench.scene->rig(), joint, turn_of(bench, joint), degrees};
}

void draw_rig_section(Workbench& bench, Panels& panels) {
  const auto shown = bench.scene->rig();
  if (panels.outline.show(shown)) panels.indentation = {};
  if (!shown || !ImGui::CollapsingHeader("Rig", ImGuiTreeNodeFlags_DefaultOpen)) return;
  chosen_joint(bench, panels.angles, *shown);
  constexpr float most_lines = 14;
  const float lines = std::min(static_cast<float>(panels.outline.seen().size()), most_lines);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float high = lines * ImGui::GetTextLineHeightWithSpacing() + 2 * style.WindowPadding.y;
  if (ImGui::BeginChild("joints", {0, high}, true, ImGuiWindowFlags_NavFlattened)) {
    scroll_to_chosen(bench, panels.outline, panels.listed_joint);
    hierarchy(bench, panels, *shown);
  }
  ImGui::EndChild();
  const auto character = bench.scene->character();
  if (character) ImGui::TextWrapped("%s", words_of(*character).c_str());
}

}  // namespace curveskel::viewer
