// From a file's surface and its curve skeleton to the rig of all that is in the file: parts, the
// plan of the body, joints, weights, names.
#pragma once

#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/role_names.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// With a root that somebody has chosen (`rig.joints.root`) there is no plan, and no part follows.
struct CharacterOptions {
  RigOptions rig;
  PartOptions parts;
  PlanOptions plan;
  NameStyle names = NameStyle::automatic;
  int joint_budget = 100;  ///< of a figure, at most, see `within_budget`; 0 = any number
};

struct CharacterRig {
  Rig rig;  ///< by the file's vertices
  RigParts parts;
  BodyPlan plan;                      ///< of the first figure
  std::vector<BodyPlan> other_plans;  ///< of a scene's other figures, the second first
  std::vector<bool> follows;   ///< of each of the file's vertices, true if it is not of the body
  int joints_left_out = 0;     ///< by the budget
  int joints_over_budget = 0;  ///< at most, of a figure: what a body needs stays
};

/// The curve of the body alone: what only followers collapsed to is left out, and node_of_vertex is
/// by the vertices of `body_of`. Precondition: the skeleton has a node_of_vertex, by the vertices
/// of which `parts` are. O(#V + #N).
[[nodiscard]] CurveSkeleton skeleton_of_body(const CurveSkeleton& skeleton, const RigParts& parts);

/// `find_plan`, `make_planned_rig`, `rig_of_given`, `name_roles`; where two or more bodies stand
/// clear of one another and each is built to a plan, for each of them, side by side: the joints of
/// the first come first, names and roles of the k-th begin with "figure<k>_". `body` is what
/// `body_of` leaves of a repaired surface, the skeleton the body's, `given` the file's surface in
/// triangles. The result's `parts` are empty. Throws what these throw, and Error(Fault::input) for
/// a body whose map is not of `given`'s vertices, or has rims or sheets that are no vertices of it.
[[nodiscard]] CharacterRig rig_body(const Surface& given, const RepairedSurface& body,
                                    const CurveSkeleton& skeleton,
                                    const CharacterOptions& options = {},
                                    const Monitor& monitor = {});

/// The same from the skeleton of the whole repaired surface, after `find_parts`, within the budget.
/// A skeleton without node_of_vertex does not say what its curves are of: then no part follows, as
/// where it has none of the body's; its vertices go to the nearest balls.
/// `certificate` is that of the skeleton, if there is one: then `plan.made_of_tubes` is judged as
/// `rig_polygons` does, by the body without the parts that follow.
[[nodiscard]] CharacterRig rig_character(const Surface& given, const RepairedSurface& repaired,
                                         const CurveSkeleton& skeleton,
                                         const CharacterOptions& options = {},
                                         const Monitor& monitor = {},
                                         const Certificate* certificate = nullptr);

/// The character with fewer joints: without those that lie on branches of a shorter life than the
/// limit and without those below them, but with all that VRM requires of a human, and with the
/// trunk and head of others. Mirror images (".L", ".R") have the longer life of the two, the digits
/// of a hand that of the middle one: they come and go together. A joint that stays has its name and
/// its place at every limit, and moves what the joints below it moved. `skeleton`, of which the rig
/// was made, has lives; without them nothing goes, and roots stay at every limit. O(weights +
/// joints times #E).
[[nodiscard]] CharacterRig level_of_character(CharacterRig character, const CurveSkeleton& skeleton,
                                              double least_life);

/// The character with at most so many joints in each of its figures: from the tips inward, and of
/// two bones in a row that have no role the lower one's joint, those go first that move the least
/// of the surface `given` (with what those that went moved), of equals the one with the shorter
/// bone; joints without a role before those with one, mirror images (".L", ".R") together, of the
/// digits of a human's hands all last joints together, then all middle ones, then all first ones.
/// All that VRM requires of a human stays, and so do roots and the trunk, neck and head of others.
/// The nearest ancestor that stays moves what a joint that went has moved. 0 = all stay. Throws
/// Error(Fault::usage) below 0. O(weights + joints log joints).
[[nodiscard]] CharacterRig within_budget(CharacterRig character, const Surface& given, int joints);

}  // namespace curveskel
