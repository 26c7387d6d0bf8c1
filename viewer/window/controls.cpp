#include "viewer/window/controls.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace curveskel::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double flight_seconds = 0.35;
constexpr float click_pixels = 4;  // a shorter motion is a click

float aspect_of(const Area& picture) {
  return std::max(picture.width, 1.0F) / std::max(picture.height, 1.0F);
}

/// Within the picture, in its pixels.
glm::vec2 pointer_in(const Area& picture) {
  const ImVec2 at = ImGui::GetIO().MousePos;
  return {at.x - picture.x, at.y - picture.y};
}

bool holds(const Area& picture, const glm::vec2& at) {
  return at.x >= 0 && at.y >= 0 && at.x < picture.width && at.y < picture.height;
}

bool pressed(int key) { return ImGui::IsKeyPressed(key, false); }

template <typename Choice, std::size_t Count>
void next(Choice& value, const NameTable<Choice, Count>& table) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const auto& entry) { return entry.value == value; });
  const auto after = at == table.end() || at + 1 == table.end() ? table.begin() : at + 1;
  value = after->value;
}

/// The pointer's place in the plane through `place` that faces the viewer.
glm::vec3 beside(const Camera& camera, const glm::vec3& place, const glm::vec2& at,
                 const Area& picture) {
  const PickRay ray = ray_through(camera, at.x, at.y, static_cast<int>(picture.width),
                                  static_cast<int>(picture.height));
  const glm::vec3 normal = camera.axis(2);
  const float along = glm::dot(place - ray.origin, normal) / glm::dot(ray.direction, normal);
  return ray.origin + ray.direction * along;
}

}  // namespace

void Controls::fly(Workbench& bench, const Camera& to) {
  flight_ = Flight{bench.scene->camera, to, Clock::now()};
}

void Controls::fly_on(Workbench& bench) {
  if (!flight_) return;
  const double gone = std::chrono::duration<double>(Clock::now() - flight_->began).count();
  const auto share = static_cast<float>(std::min(gone / flight_seconds, 1.0));
  bench.scene->camera = between(flight_->from, flight_->to, share);
  if (share >= 1) flight_.reset();
}

void Controls::fit_all(Workbench& bench, const Area& picture, bool at_once) {
  Camera to = bench.scene->camera;
  fit(to, bench.scene->points(), aspect_of(picture));
  if (at_once) {
    bench.scene->camera = to;
  } else {
    fly(bench, to);
  }
}

void Controls::look_at(Workbench& bench, const glm::vec3& place) {
  Camera to = bench.scene->camera;
  to.target = place;
  constexpr float near = 0.25F;  // of the diagonal
  to.distance = std::min(to.distance * 0.6F,
                         std::max(near * bench.scene->bounds().diagonal(), to.distance * 0.3F));
  fly(bench, to);
}

void Controls::look_at_side(Workbench& bench, const Area& picture, Side side) {
  Camera to = bench.scene->camera;
  look_from(to, side, bench.scene->best_axes());
  fit(to, bench.scene->points(), aspect_of(picture));
  fly(bench, to);
}

bool Controls::begin_drag(const Workbench& bench, const Panels& panels) {
  const ImGuiIO& io = ImGui::GetIO();
  bool began = false;
  for (int button = 0; button < 3; ++button) {
    if (!ImGui::IsMouseClicked(button)) continue;
    began = true;
    button_ = button;
    travelled_ = 0;
    doubled_ = ImGui::IsMouseDoubleClicked(0);
    drag_ = button == 1 ? Drag::zoom : button == 2 || io.KeyShift ? Drag::pan : Drag::orbit;
    if (button != 0 || !io.KeyCtrl || bench.running()) continue;
    if (panels.hovered.kind == Pick::Kind::node) drag_ = Drag::node;
    if (panels.hovered.kind == Pick::Kind::joint) drag_ = Drag::joint;
    turns_ = false;
    dragged_ = panels.hovered.index;
  }
  return began;
}

void Controls::drag(Workbench& bench, const Area& picture) {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  travelled_ += std::abs(moved.x) + std::abs(moved.y);
  if (travelled_ < click_pixels * scale_ || (moved.x == 0 && moved.y == 0)) return;
  flight_.reset();
  Camera& camera = bench.scene->camera;
  const float turn = 4.0F / std::max(picture.height, 1.0F);
  switch (drag_) {
    case Drag::none:
    case Drag::node:
      break;
    case Drag::joint:
      pull(bench, picture);
      break;
    case Drag::orbit:
      orbit(camera, moved.x * turn, moved.y * turn);
      break;
    case Drag::pan:
      pan(camera, moved.x, moved.y, static_cast<int>(picture.height));
      break;
    case Drag::zoom:
      zoom(camera, std::exp(moved.y * turn), 0, 0);
      break;
  }
}

/// The joint follows the pointer, in the plane that faces the viewer.
void Controls::pull(Workbench& bench, const Area& picture) {
  const auto rig = bench.scene->rig();
  if (!rig || dragged_ < 0 || dragged_ >= rig->joints.rows()) return;
  if (!std::exchange(turns_, true)) bench.begin_turning();
  const glm::vec3 place =
      shown_point(bench.scene->joints_now().row(dragged_), bench.scene->document.space);
  bench.pull_joint(dragged_, beside(bench.scene->camera, place, pointer_in(picture), picture));
}

void Controls::end_drag(Workbench& bench, const Panels& panels, const Area& picture) {
  const Drag ended = std::exchange(drag_, Drag::none);
  const auto skeleton = bench.scene->skeleton();
  if (ended == Drag::node && travelled_ >= click_pixels * scale_ && skeleton &&
      dragged_ < skeleton->nodes.rows()) {
    const glm::vec3 place = shown_point(skeleton->nodes.row(dragged_), bench.scene->document.space);
    bench.move(dragged_, beside(bench.scene->camera, place, pointer_in(picture), picture));
    return;
  }
  if (travelled_ >= click_pixels * scale_ || button_ != 0) return;
  if (doubled_ && panels.hovered.kind != Pick::Kind::nothing) {
    look_at(bench, panels.hovered.place);
    return;
  }
  bench.select(panels.hovered, ImGui::GetIO().KeyShift);
}

void Controls::mouse(Workbench& bench, Panels& panels, const Area& picture) {
  const ImGuiIO& io = ImGui::GetIO();
  scale_ = panels.scale;
  const glm::vec2 at = pointer_in(picture);
  // A click that closes a list counts as well.
  const bool over = !io.WantCaptureMouseUnlessPopupClose && holds(picture, at);
  bool began = false;
  if (drag_ == Drag::none) {
    panels.hovered = over ? pick(*bench.scene, at, static_cast<int>(picture.width),
                                 static_cast<int>(picture.height), scale_)
                          : Pick{};
    began = over && begin_drag(bench, panels);
  }
  if (drag_ != Drag::none) {
    if (!began) drag(bench, picture);  // the way to the place where it began is none of it
    if (drag_ == Drag::node && travelled_ >= click_pixels * scale_) {
      ImGui::GetForegroundDrawList()->AddCircle({at.x + picture.x, at.y + picture.y}, 8 * scale_,
                                                IM_COL32(255, 200, 0, 255), 0, 2.5F * scale_);
    }
    if (!ImGui::IsMouseDown(button_)) end_drag(bench, panels, picture);
  }
  if (over && io.MouseWheel != 0) {
    flight_.reset();
    constexpr float per_notch = 0.88F;
    zoom(bench.scene->camera, std::pow(per_notch, io.MouseWheel),
         (at.x - picture.width / 2) / (picture.height / 2),
         (picture.height / 2 - at.y) / (picture.height / 2));
  }
}

void Controls::escape(Workbench& bench, Panels& panels) {
  if (bench.wants_to_abandon || bench.wants_to_replace) {
    bench.wants_to_abandon.reset();
    bench.wants_to_replace.reset();
    return;
  }
  if (panels.browser.shown()) {
    panels.browser.close();
    return;
  }
  // It is for those.
  if (ImGui::IsAnyItemActive() || is_list_open() || panel_keys_.escape_is_theirs()) return;
  if (panels.help) {
    panels.help = false;
  } else if (panel_keys_.on()) {
    panel_keys_.leave();
  } else if (bench.can_cancel()) {
    bench.cancel_what_goes_on();
  } else {
    bench.clear_selection();
    bench.clear_faults();
  }
}

void Controls::command_keys(Workbench& bench, Panels& panels) const {
  if (pressed(GLFW_KEY_O)) ask_to_open(panels);
  if (pressed(GLFW_KEY_S)) ask_to_save(bench, panels);
  if (pressed(GLFW_KEY_Z) && !ImGui::GetIO().KeyShift) bench.undo();
  if (pressed(GLFW_KEY_Y) || (pressed(GLFW_KEY_Z) && ImGui::GetIO().KeyShift)) bench.redo();
}

void Controls::side_keys(Workbench& bench, const Area& picture) {
  struct SideKeys {
    int key;
    int pad;
    Side side;
    Side with_ctrl;
  };
  constexpr std::array<SideKeys, 4> all{{{GLFW_KEY_1, GLFW_KEY_KP_1, Side::front, Side::back},
                                         {GLFW_KEY_3, GLFW_KEY_KP_3, Side::right, Side::left},
                                         {GLFW_KEY_7, GLFW_KEY_KP_7, Side::top, Side::bottom},
                                         {GLFW_KEY_9, GLFW_KEY_KP_9, Side::back, Side::front}}};
  const bool with_ctrl = ImGui::GetIO().KeyCtrl;
  for (const SideKeys& one : all) {
    if (!pressed(one.key) && !pressed(one.pad)) continue;
    look_at_side(bench, picture, with_ctrl ? one.with_ctrl : one.side);
  }
}

void Controls::look_keys(Workbench& bench, Panels& panels, const Area& picture) {
  Look& look = bench.scene->look;
  if (pressed(GLFW_KEY_S)) next(look.surface, surface_styles);
  if (pressed(GLFW_KEY_K)) next(look.skeleton, skeleton_styles);
  if (pressed(GLFW_KEY_L)) next(look.theme, themes);
  if (pressed(GLFW_KEY_E)) look.edges = !look.edges;
  if (pressed(GLFW_KEY_B)) {
    look.transparent_background = !look.transparent_background;
    bench.say(look.transparent_background ? "pictures (F12) will have no background"
                                          : "pictures (F12) will have their background");
  }
  if (pressed(GLFW_KEY_H) || pressed(GLFW_KEY_F1)) panels.help = !panels.help;
  if (pressed(GLFW_KEY_P)) {
    panels.shown = !panels.shown;
    if (!panels.shown && panel_keys_.on()) panel_keys_.leave();
  }
  if (pressed(GLFW_KEY_F12)) panels.wants_picture = true;
  if (pressed(GLFW_KEY_F)) fit_all(bench, picture, false);
  if (pressed(GLFW_KEY_O)) bench.scene->camera.orthographic ^= true;
  if (pressed(GLFW_KEY_0) || pressed(GLFW_KEY_KP_0)) look_at_side(bench, picture, Side::best);
}

void Controls::edit_keys(Workbench& bench) const {
  if (pressed(GLFW_KEY_DELETE)) bench.prune();
  if (pressed(GLFW_KEY_BACKSPACE)) bench.remove();
  if (pressed(GLFW_KEY_M)) bench.merge();
  if (pressed(GLFW_KEY_C)) bench.cut();
  if (pressed(GLFW_KEY_J)) bench.join();
  if (pressed(GLFW_KEY_N)) bench.split();
  if (pressed(GLFW_KEY_T)) bench.set_root();
  if (pressed(GLFW_KEY_G)) bench.rig();
}

void Controls::time_keys(Workbench& bench) const {
  if (pressed(GLFW_KEY_SPACE)) {
    const bool active = bench.running() && bench.run_state() == Run::State::running;
    active ? bench.pause() : bench.resume();
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_RIGHT)) bench.step(!pressed(GLFW_KEY_RIGHT));
  const std::size_t moment = bench.scene->moment;
  if (ImGui::IsKeyPressed(GLFW_KEY_LEFT) && moment > 0) bench.go_to(moment - 1);
  if (pressed(GLFW_KEY_HOME)) bench.rewind();
  if (pressed(GLFW_KEY_END)) bench.go_to(bench.scene->recording.moments().size() - 1);
}

/// The panels appear where they were hidden.
void Controls::heed_tab(const Workbench& bench, Panels& panels) {
  using Over = PanelKeys::Over;
  const bool question = bench.wants_to_replace || bench.wants_to_abandon;
  const bool dialogue = question || panels.browser.shown();
  const Over over = question         ? Over::question
                    : dialogue       ? Over::dialogue
                    : is_list_open() ? Over::list
                                     : Over::nothing;
  if (panel_keys_.begin(over) && !dialogue) panels.shown = true;
}

void Controls::keys(Workbench& bench, Panels& panels, const Area& picture) {
  heed_tab(bench, panels);
  if (pressed(GLFW_KEY_ESCAPE)) escape(bench, panels);
  // WantTextInput outlives the field by a frame.
  const bool typing = ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive();
  if (typing) return;
  if (ImGui::GetIO().KeyCtrl && pressed(GLFW_KEY_Q)) wants_to_leave = true;  // a dialogue or not
  if (panels.browser.shown() || bench.wants_to_replace || bench.wants_to_abandon) return;
  side_keys(bench, picture);
  if (ImGui::GetIO().KeyCtrl) {
    command_keys(bench, panels);
    return;
  }
  look_keys(bench, panels, picture);
  edit_keys(bench);
  if (pressed(GLFW_KEY_R)) bench.reload();
  if (!panel_keys_.on()) time_keys(bench);
}

void Controls::update(Workbench& bench, Panels& panels, const Area& picture) {
  if (bench.wants_fit) {
    flight_.reset();
    fit_all(bench, picture, true);
    bench.wants_fit = false;
  }
  if (bench.wants_look_at) {
    look_at(bench, *bench.wants_look_at);
    bench.wants_look_at.reset();
  }
  keys(bench, panels, picture);
  mouse(bench, panels, picture);
  fly_on(bench);
}

}  // namespace curveskel::viewer
