#include "viewer/model/rigging.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include <curveskel/rig_polygons.hpp>
#include "app/rig_findings.hpp"

namespace curveskel::viewer {
namespace {

/// To those of the file, from those of the repaired surface.
void put_on_input_vertices(RigParts& parts, const Eigen::VectorXi& vertex_of_input) {
  const Eigen::VectorXi of_repaired = parts.part_of_vertex;
  parts.part_of_vertex = vertex_of_input.unaryExpr([&](int vertex) {
    return vertex >= 0 && vertex < of_repaired.size() ? of_repaired[vertex] : -1;
  });
}

}  // namespace

RunOptions options_for_rig(RunOptions options, double detail, const CharacterOptions& character) {
  options.extract.embed.detail = detail;
  options.character = character;
  double& least_sheet = options.repair.least_sheet;
  if (least_sheet <= 0) least_sheet = repair_for_rigs().least_sheet;
  return options;
}

FoundRig rig_of_surface(const Document& document, const RunOptions& options, const Monitor& monitor,
                        ExtractionCache& cache) {
  const RigPolygonsOptions wanted{options.repair, options.extract, options.character,
                                  options.extract.threads};
  PolygonsRig made = rig_polygons(*document.polygons(), {}, wanted, monitor, cache);
  put_on_input_vertices(made.character.parts, made.vertex_of_input);
  FoundRig found;
  const std::string failed = skeleton_findings(made, wanted);
  if (!failed.empty()) found.findings.push_back(failed);
  for (std::string& finding : rig_findings(made.character, options.character)) {
    found.findings.push_back(std::move(finding));
  }
  found.character = std::make_shared<const CharacterRig>(std::move(made.character));
  return found;
}

std::shared_ptr<const CharacterRig> rig_of(
    const Document& document, const RepairedSurface& repaired, const CurveSkeleton& skeleton,
    const Certificate* certificate, const CharacterOptions& options, const Monitor& monitor) {
  const CurveSkeleton mapped =
      skeleton_of_repaired(skeleton, repaired.vertex_of_input, repaired.surface.positions.rows());
  CharacterOptions facing = options;
  facing.rig.faces_minus_z = facing.plan.faces_minus_z = document.faces_minus_z;
  facing.plan.z_is_up = document.z_is_up;
  CharacterRig made =
      rig_character(document.surface, repaired, mapped, facing, monitor, certificate);
  made.rig.to_y_up = axes_to_gltf(document.format, document.to_gltf, made.plan, facing.plan.up);
  put_on_input_vertices(made.parts, repaired.vertex_of_input);
  return std::make_shared<const CharacterRig>(std::move(made));
}

void give_roles(CharacterRig& character, const std::vector<GivenRole>& roles, double size,
                NameStyle style) {
  constexpr double near = 0.01;
  const std::vector<std::string> known = roles_of(character.plan.plan);
  Rig& rig = character.rig;
  for (const GivenRole& given : roles) {
    const bool fits =
        given.role.empty() || std::find(known.begin(), known.end(), given.role) != known.end();
    if (!fits || rig.joints.rows() == 0) continue;
    const Eigen::VectorXd far = (rig.joints.rowwise() - given.place).rowwise().norm();
    Eigen::Index joint = given.joint;
    const auto nearest = std::min_element(far.begin(), far.end());
    if (joint >= far.size() || far[joint] > *nearest) joint = nearest - far.begin();
    const auto at = static_cast<std::size_t>(joint);
    const bool has_it = at < rig.roles.size() && rig.roles[at] == given.role;
    if (far[joint] > near * size || has_it) continue;
    assign_role(rig, character.plan, static_cast<int>(joint), given.role, style);
  }
}

Moment moment_of(std::shared_ptr<const CharacterRig> character) {
  Moment moment;
  moment.stage = "rig";
  moment.rig = std::shared_ptr<const Rig>(character, &character->rig);
  moment.character = std::move(character);
  return moment;
}

std::string words_of(const CharacterRig& character) {
  std::string words = fmt::format("{} joints", character.rig.joints.rows());
  if (character.joints_left_out > 0) {
    words += fmt::format(", {} more left out", character.joints_left_out);
  }
  if (character.plan.plan != BodyKind::none) {
    words +=
        fmt::format(", {} ({})", name_of(body_kinds, character.plan.plan), character.plan.reason);
  }
  const auto& parts = character.parts.parts;
  const auto followers =
      std::count_if(parts.begin(), parts.end(), [](const RigPart& part) { return part.follows; });
  if (followers > 0) words += fmt::format("; {} of {} parts follow", followers, parts.size());
  return words;
}

std::string words_on_sheets(const RepairedSurface& repaired, const RepairOptions& options) {
  const auto left_out = repaired.repairs.sheets_dropped;
  if (left_out == 0 || options.least_sheet > 0) return {};
  return fmt::format(
      "{} open or flat part{} no joints; large ones have their own with a least sheet of {} "
      "(on the left, under More; --least-sheet)",
      left_out, left_out == 1 ? " has" : "s have", repair_for_rigs().least_sheet);
}

}  // namespace curveskel::viewer
