// Mouse and keys over the picture.
#pragma once

#include <chrono>
#include <glm/glm.hpp>
#include <optional>

#include "viewer/window/panel_keys.hpp"
#include "viewer/window/panels.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {

class Controls {
 public:
  /// Within an ImGui frame: turns events of mouse and keys into actions.
  void update(Workbench& bench, Panels& panels, const Area& picture);
  /// Within the same frame, after the panels.
  void end_frame() { panel_keys_.end(); }
  /// True while the camera is on its way.
  [[nodiscard]] bool flying() const { return flight_.has_value(); }
  bool wants_to_leave = false;

 private:
  enum class Drag { none, orbit, pan, zoom, node, joint };
  struct Flight {
    Camera from;
    Camera to;
    std::chrono::steady_clock::time_point began;
  };

  void fly(Workbench& bench, const Camera& to);
  void fly_on(Workbench& bench);
  void fit_all(Workbench& bench, const Area& picture, bool at_once);
  void look_at(Workbench& bench, const glm::vec3& place);
  void look_at_side(Workbench& bench, const Area& picture, Side side);
  void mouse(Workbench& bench, Panels& panels, const Area& picture);
  /// True if a button went down in this frame.
  bool begin_drag(const Workbench& bench, const Panels& panels);
  void drag(Workbench& bench, const Area& picture);
  void pull(Workbench& bench, const Area& picture);
  void end_drag(Workbench& bench, const Panels& panels, const Area& picture);
  void keys(Workbench& bench, Panels& panels, const Area& picture);
  void command_keys(Workbench& bench, Panels& panels) const;
  void side_keys(Workbench& bench, const Area& picture);
  void look_keys(Workbench& bench, Panels& panels, const Area& picture);
  void edit_keys(Workbench& bench) const;
  void escape(Workbench& bench, Panels& panels);
  void time_keys(Workbench& bench) const;
  void heed_tab(const Workbench& bench, Panels& panels);

  PanelKeys panel_keys_;
  Drag drag_ = Drag::none;
  int button_ = 0;
  int dragged_ = -1;     // node or joint
  float scale_ = 1;      // of the display
  float travelled_ = 0;  // pixels since the button went down
  bool doubled_ = false;
  bool turns_ = false;  // the dragged joint, which the workbench was told of
  std::optional<Flight> flight_;
};

}  // namespace curveskel::viewer
