#include "viewer/headless/open_for_pictures.hpp"

#include <algorithm>
#include <string>

#include "app/verbs/verbs.hpp"

namespace curveskel::viewer {
namespace {

/// The option that would have no effect without a rig; empty if there is none.
std::string option_of_rig(const ViewOptions& options) {
  const ColourBy colour = options.look.surface_colour;
  if (colour == ColourBy::weight || colour == ColourBy::role) {
    return "--colour " + std::string(name_of(colourings, colour));
  }
  return !options.joint.empty() ? "--joint" : !options.turns.empty() ? "--turn" : "";
}

void require_rig_for(const ViewOptions& options, const Rig* rig) {
  if (options.stage.stage == "rig") return;
  const std::string option = option_of_rig(options);
  if (rig == nullptr && !option.empty()) {
    throw UsageError(option + " needs a rig: add --stage rig, or name a file that has one");
  }
  const ColourBy colour = options.look.surface_colour;
  const bool has_roles =
      rig != nullptr && std::any_of(rig->roles.begin(), rig->roles.end(),
                                    [](const std::string& role) { return !role.empty(); });
  if (colour == ColourBy::part || (colour == ColourBy::role && !has_roles)) {
    throw UsageError("--colour " + std::string(name_of(colourings, colour)) +
                     " needs a rig that is made: add --stage rig");
  }
}

}  // namespace

Document open_for_pictures(const ViewOptions& options, const Monitor& monitor) {
  Document document = open_document(options.files, monitor);
  require_rig_for(options, document.rig.get());
  const std::string& stage = options.stage.stage;
  const bool shows_curve = options.stage_given && stage != "input" && stage != "rig";
  if (shows_curve && option_of_rig(options).empty()) document.rig = nullptr;
  return document;
}

}  // namespace curveskel::viewer
