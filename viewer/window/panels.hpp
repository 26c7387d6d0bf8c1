// The panels round the picture: run and parameters, look, certificate, timeline, status.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "viewer/model/hierarchy.hpp"
#include "viewer/software/frame_times.hpp"
#include "viewer/window/file_browser.hpp"
#include "viewer/workbench/pick.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {

/// A part of the window, in ImGui's units from the upper left corner.
struct Area {
  float x = 0;
  float y = 0;
  float width = 0;
  float height = 0;
};

/// The smallest of whole pixels that holds it.
[[nodiscard]] Area whole_pixels(const Area& area);

/// The places of things. A thing too small to be shown has no width.
struct Layout {
  Area picture;
  Area left;
  Area right;
  Area timeline;
  Area status;
};

/// Values that change all the time, as shown: a few times a second, so that they can be read.
struct Glance {
  double last_milliseconds = 0;
  double slow_milliseconds = 0;  ///< 99 of 100 pictures take less
  double fraction = 0;           ///< of the stage
  std::chrono::steady_clock::time_point since;
};

/// The angles of the chosen joint as a person set them; one turn has several.
struct TurnAngles {
  std::shared_ptr<const Rig> rig;
  int joint = -1;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< theirs
  std::array<float, 3> degrees{};                            ///< about x, then y, then z
};

/// The step from a line of the outline to those below it, and the outline that it is for.
struct Indentation {
  float step = 0;
  float room = 0;         ///< for all of a line
  std::size_t lines = 0;  ///< that are seen
  int glyphs = 0;         ///< that the font has
};

/// State that the panels keep from one frame to the next.
struct Panels {
  bool shown = true;
  bool help = false;
  bool may_be_coarse = true;  ///< while things move, where the machine is slow
  bool coarse = false;        ///< the picture is so now
  FileBrowser browser;
  FieldText vrm_texts;
  Outline outline;  ///< of the rig
  Indentation indentation;
  int listed_joint = -1;  ///< whose line was last made to be seen
  TurnAngles angles;
  float scale = 1;  ///< of letters, by the display
  FrameTimes times;
  Glance glance;
  Pick hovered;
  std::string gl;        ///< the driver
  std::string transfer;  ///< how positions come to be drawn
  bool wants_picture = false;
  bool may_leave = false;  ///< whatever is lost
};

/// For a window of this size in ImGui's units; small windows have narrow panels.
[[nodiscard]] Layout lay_out(float width, float height, float scale, bool panels);

/// All of them, within an ImGui frame; a person's actions reach the workbench at once.
void draw_panels(Workbench& bench, Panels& panels, const Layout& layout);

/// Texts that the panels show and that come from files, folders or a person.
void for_each_name(const Workbench& bench, const Panels& panels,
                   const std::function<void(const std::string&)>& visit);

/// Every moment as a step, with area, volume and residual as curves; a drag goes to a moment.
void draw_timeline(Workbench& bench, const Area& area);

/// Colours and roundness; light or dark.
void style_panels(Theme theme, float scale);

void ask_to_open(Panels& panels);
/// Opens the dialogue that names a file for the skeleton, or for the rig where it is shown.
void ask_to_save(const Workbench& bench, Panels& panels);

/// The angles of the joint's turn: those that were set last, where they still are its.
[[nodiscard]] const std::array<float, 3>& angles_of(TurnAngles& kept, const Workbench& bench,
                                                    int joint);
/// Turns the joint so, and keeps the angles.
void set_angles(TurnAngles& kept, Workbench& bench, int joint, const std::array<float, 3>& degrees);

/// Text beside the pointer: the thing under it, in numbers and units.
[[nodiscard]] std::string description_of(const Pick& picked, const Workbench& bench);

}  // namespace curveskel::viewer
