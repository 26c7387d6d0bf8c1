// The last entry of the timeline: joints and weights from the skeleton.
#pragma once

#include <memory>
#include <string>

#include <curveskel/repair.hpp>
#include <curveskel/rig_character.hpp>
#include "viewer/model/document.hpp"
#include "viewer/model/recording.hpp"

namespace curveskel::viewer {

/// The rig and its parts by the vertices of the document's file; node_of_vertex of the skeleton (if
/// it has one) is by these, too. Precondition: the document has a surface, `repaired` was made of
/// it.
[[nodiscard]] std::shared_ptr<const CharacterRig> rig_of(const Document& document,
                                                         const RepairedSurface& repaired,
                                                         const CurveSkeleton& skeleton,
                                                         const CharacterOptions& options,
                                                         const Monitor& monitor);

[[nodiscard]] Moment moment_of(std::shared_ptr<const CharacterRig> character);

/// "73 joints, humanoid (one pair of legs ...); 33 of 48 parts follow".
[[nodiscard]] std::string words_of(const CharacterRig& character);

}  // namespace curveskel::viewer
