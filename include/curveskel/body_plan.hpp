// How a body is built: which limbs are legs and arms, where its head is, and the joints that an
// animator would give it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class BodyKind : std::uint8_t {
  automatic,
  none,
  humanoid,
  quadruped,
  bird,
  tailed_biped,
  fish,
  other
};
inline constexpr NameTable<BodyKind, 8> body_kinds{{
    {BodyKind::automatic, "auto", "found from the curve"},
    {BodyKind::none, "none", "not looked for: joints where the curve has them, no roles"},
    {BodyKind::humanoid, "humanoid", "upright on one pair of legs, with arms"},
    {BodyKind::quadruped, "quadruped", "on two pairs of legs"},
    {BodyKind::bird, "bird", "on one pair of legs, with wings"},
    {BodyKind::tailed_biped, "biped-with-tail", "on one pair of legs, leaning ahead of a tail"},
    {BodyKind::fish, "fish", "a long level trunk with fins: fish, whales, dolphins"},
    {BodyKind::other, "other", "none of these: a tree, a thing"},
}};

/// Directions of a file.
enum class Direction : std::uint8_t { automatic, x, y, z, minus_x, minus_y, minus_z };
inline constexpr NameTable<Direction, 7> directions{{
    {Direction::automatic, "auto", "found"},
    {Direction::x, "x", ""},
    {Direction::y, "y", ""},
    {Direction::z, "z", ""},
    {Direction::minus_x, "-x", ""},
    {Direction::minus_y, "-y", ""},
    {Direction::minus_z, "-z", ""},
}};

struct PlanOptions {
  BodyKind plan = BodyKind::automatic;
  Direction up = Direction::automatic;  ///< automatic: y, as in glTF, or z
  Direction front =
      Direction::automatic;  ///< automatic: of what stands on two legs where its toes point, of
                             ///< quadrupeds by their heads and ears, of fish the thicker half; else
                             ///< z (with z up -y), or the opposite if `faces_minus_z`
  bool faces_minus_z = false;  ///< what the file says, as VRM 0.x does
  bool z_is_up = false;        ///< what the file says: with `up` automatic z is tried first
  bool made_of_tubes = true;   ///< what the certificate says: of others no plan is found unless one
                               ///< is asked for, as any room has corners like legs; but a bird of
                               ///< which all but its flat wings is, and a human whose legs hang
                               ///< from a component that is
  std::vector<std::int32_t> sheets = {};  ///< a vertex of each component that was made of a sheet,
                                          ///< see RepairedSurface; no large one need be the body
  bool by_proportion = true;  ///< a human who is asked for, and of whom legs or arms are not seen,
                              ///< has them where a standing human has
};

/// A joint that a plan asks for.
struct PlannedJoint {
  std::string role;  ///< of humanoids in VRM's words (hips, leftUpperArm), of others in Rigify's
                     ///< (spine, thigh.L, front_shin.R)
  int parent = -1;   ///< among the planned joints, before it; -1 = the root, which is the first
  int node = -1;     ///< of the skeleton, that it is nearest to; -1: between its neighbours'
  Eigen::RowVector3d position;
  std::string reason;    ///< why it lies there
  bool is_last = false;  ///< the limb beyond is one bone, as of a fingertip
  std::optional<Eigen::RowVector3d> end = std::nullopt;  ///< of its bone, where no joint says so
};

/// The joints that VRM requires of a human.
inline constexpr std::array required_human_roles{
    "hips",         "spine",         "head",          "leftUpperArm",  "leftLowerArm",
    "leftHand",     "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",
    "leftLowerLeg", "leftFoot",      "rightUpperLeg", "rightLowerLeg", "rightFoot"};

struct BodyPlan {
  BodyKind plan = BodyKind::none;
  std::string reason;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: to the body's left, up, its front
  std::vector<PlannedJoint> joints;                    ///< the root first; empty for other and none
  std::vector<std::string> missing;                    ///< required roles that have no joint
  bool is_forced = false;      ///< as asked: the curve shows another plan, or none
  bool is_in_pose = false;     ///< left and right are no images: limbs are told by their shape
  bool by_proportion = false;  ///< a human's who was asked for: some of its limbs are not seen. The
                               ///< rig has these joints alone, and their bones hold all that is
                               ///< near them
};

/// Throws Error(Fault::usage) for a plan or a direction that there is not, and where up and front
/// are one direction.
void require_valid(const PlanOptions& options);

/// Tips that are each other's mirror images make pairs of limbs; what lies between their crossings
/// and the tips in the mirror plane is the trunk. Pairs that reach the ground are legs. Places
/// along limbs are shares of their height or length, means over artists' rigs, and features of the
/// curve: where legs part, where an arm leaves the trunk, the narrowest place of a wrist and of a
/// neck. docs/rigging.md has the rules. Unless one is asked for, no plan is found of curves with
/// more than 2,000 ends, as trees and crowds have. O(#V + #N times the number of tips). Throws as
/// `require_valid` and of a sheet that is no vertex, and Error(Fault::input) for a skeleton whose
/// numbers are none of its nodes, or whose node_of_vertex is of another surface.
[[nodiscard]] BodyPlan find_plan(const Surface& surface, const CurveSkeleton& skeleton,
                                 const PlanOptions& options = {});

}  // namespace curveskel
