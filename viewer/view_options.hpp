// Options of the viewer's command line.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/preset.hpp>
#include <curveskel/rig_files.hpp>
#include "viewer/model/run.hpp"
#include "viewer/render/camera.hpp"
#include "viewer/render/look.hpp"

namespace curveskel::viewer {

/// A moment by its name: "input", "fairing:2", "contraction:3", "skeleton" (the default), "rig".
struct StageWish {
  std::string stage = "skeleton";  ///< as in Moment
  int iteration = -1;              ///< -1 = the last one
};

/// Degrees about x, then y, then z, at a joint.
struct JointTurn {
  std::string joint;
  std::array<double, 3> degrees{};
};

struct ViewOptions {
  std::vector<std::filesystem::path> files;
  std::string screenshot;           ///< PNG to write instead of a window; empty = none
  std::filesystem::path turntable;  ///< folder for pictures all around; empty = none
  bool two_sides = false;  ///< the screenshot: from the best side and from a right angle to it
  int frames = 36;         ///< of the turntable
  int width = 1600;        ///< pixels, of the window or the picture
  int height = 1000;       ///< pixels
  CameraWish camera;
  bool perspective = true;
  StageWish stage;
  bool stage_given = false;
  bool may_be_coarse = true;  ///< the window's picture, while things move
  bool run = true;            ///< a surface without a skeleton is worked on at once
  double time_limit_seconds = 0;
  std::vector<JointTurn> turns;  ///< of a rig, in pictures
  std::string joint;             ///< of a rig: its name; empty = none
  std::string frame_times;  ///< CSV of the window's frame times, written at the end; empty = none
  Look look;
  Preset preset = Preset::standard;
  RunOptions pipeline;
  VrmMeta vrm;  ///< of rigs that the window saves as .vrm, to begin with
};

}  // namespace curveskel::viewer
