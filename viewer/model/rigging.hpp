// The last entry of the timeline: joints and weights from the skeleton.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_character.hpp>
#include "viewer/model/document.hpp"
#include "viewer/model/history.hpp"
#include "viewer/model/recording.hpp"

namespace curveskel::viewer {

/// The rig and its parts by the vertices of the document's file; node_of_vertex of the skeleton (if
/// it has one) is by these, too. Precondition: the document has a surface, `repaired` was made of
/// it; the skeleton's certificate, if there is one, belongs to `repaired`.
[[nodiscard]] std::shared_ptr<const CharacterRig> rig_of(
    const Document& document, const RepairedSurface& repaired, const CurveSkeleton& skeleton,
    const Certificate* certificate, const CharacterOptions& options, const Monitor& monitor);

/// Gives each joint its role, in order, where the rig has a joint in the same place (within a
/// hundredth of `size`, the surface's diagonal) and its plan has the role; passes over the others.
void give_roles(CharacterRig& character, const std::vector<GivenRole>& roles, double size,
                NameStyle style);

[[nodiscard]] Moment moment_of(std::shared_ptr<const CharacterRig> character);

/// "73 joints, humanoid (one pair of legs ...); 33 of 48 parts follow".
[[nodiscard]] std::string words_of(const CharacterRig& character);

/// Says that sheets have no joints, and how they get some; empty where none was left out or
/// `least_sheet` has decided.
[[nodiscard]] std::string words_on_sheets(const RepairedSurface& repaired,
                                          const RepairOptions& options);

}  // namespace curveskel::viewer
