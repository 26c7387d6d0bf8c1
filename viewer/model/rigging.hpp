// The last entry of the timeline: joints and weights from the skeleton.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_character.hpp>
#include "viewer/model/document.hpp"
#include "viewer/model/history.hpp"
#include "viewer/model/recording.hpp"
#include "viewer/model/run.hpp"

namespace curveskel::viewer {

/// A rig, and what whoever asked for it should read.
struct FoundRig {
  std::shared_ptr<const CharacterRig> character;
  std::vector<std::string> findings;
};

/// A run's options for the rig of the same surface. Sheets that no run was asked for get joints,
/// too, as by `curveskel rig`.
[[nodiscard]] RunOptions options_for_rig(RunOptions options, double detail,
                                         const CharacterOptions& character);

/// The rig that `curveskel rig` makes of the document's file, as it is shown, with these options;
/// its parts by the vertices of the file. `cache` may be that of any extraction. Precondition: the
/// document has a surface. Errors as of `rig_polygons`.
[[nodiscard]] FoundRig rig_of_surface(const Document& document, const RunOptions& options,
                                      const Monitor& monitor, ExtractionCache& cache);

/// The same of a skeleton that somebody has read or corrected. The rig and its parts are by the
/// vertices of the document's file; node_of_vertex of the skeleton (if it has one) is by these,
/// too. Precondition: the document has a surface, `repaired` was made of it; the skeleton's
/// certificate, if there is one, belongs to `repaired`.
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
