// The command line of `curveskel rig`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/rig_polygons.hpp>
#include <curveskel/role_names.hpp>

namespace curveskel {

struct RigArguments {
  std::filesystem::path mesh;
  std::vector<std::string> outputs;
  std::string skeleton;  ///< empty = extract it
  bool quiet = false;
  bool bare = false;
  bool keep_rig = false;
  bool as_shown = false;
  bool as_bound = true;  ///< follows from the others
  std::string joints;    ///< empty = made
  VrmMeta vrm;
  RestPose pose = RestPose::input;
  bool ground_root = false;
  bool no_ends = false;
  double time_limit_seconds = 0;
  int fair_iterations = 0;
  int threads = 0;
  RepairOptions repair = repair_for_rigs();
  ExtractOptions extract;
  RigOptions rig;
  PartOptions parts;
  PlanOptions plan;
  NameStyle names = NameStyle::automatic;
  int joint_budget = CharacterOptions{}.joint_budget;
  std::string report;  ///< empty = none
};

/// The arguments must outlive the parser.
void add_rig_options(CLI::App& parser, RigArguments& arguments);

}  // namespace curveskel
