// The places of joints, by the plan of the body. All in the frame of the curve's tree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/body_plan.hpp>
#include "rig/plan/curve_tree.hpp"

namespace curveskel {

constexpr double near_ground = 0.06;  ///< of the height, that feet are off it at most

/// Of the left one.
struct ArmJoints {
  Eigen::Vector3d shoulder;
  Eigen::Vector3d elbow;
  Eigen::Vector3d wrist;
};

/// Limbs of a standing human that the curve does not show, by proportion; see
/// rig/plan/standing.hpp.
struct HiddenLimbs {
  struct Leg {
    Eigen::Vector3d hip;
    Eigen::Vector3d knee;
    Eigen::Vector3d ankle;
    Eigen::Vector3d toes;
    Eigen::Vector3d tip;
  };
  struct Arm {
    ArmJoints joints;
    Eigen::Vector3d fingertips;
  };
  std::optional<Leg> leg;              ///< the left one
  std::optional<Arm> arm;              ///< the left one
  std::vector<Eigen::Vector3d> trunk;  ///< middles of the body without its limbs, from below
};

struct PlanFound {
  BodyKind plan = BodyKind::other;
  std::string reason;
  std::vector<int> legs;              ///< pairs; of quadrupeds two
  int arms = -1;                      ///< pair; -1 = none
  bool spreads_wings = false;         ///< a bird whose arms are flat, see `flat_wings`
  bool is_forced = false;             ///< as asked: the curve shows another plan, or none
  bool is_astride = false;            ///< on legs wide apart
  double lean = 0;                    ///< of a biped's trunk from upright, in degrees
  std::optional<HiddenLimbs> hidden;  ///< of a human who is asked for, of whom limbs are not seen
};

/// The feet of a body in a pose may be off the ground, but for one.
enum class Standing { on_all_feet, in_pose };

[[nodiscard]] PlanFound classify(const CurveTree& tree, const Limbs& limbs, BodyKind wanted,
                                 Standing standing = Standing::on_all_feet);

/// A joint in the frame; of a pair the left one, whose right one is its mirror image.
struct Place {
  std::string role;
  std::string parent;  ///< role; empty = the root
  Eigen::Vector3d at;
  bool on_curve = true;  ///< else no node is its own
  int pair = -1;         ///< on whose curve; -1 = the trunk
  std::string reason;
  std::size_t way = 0;                                   ///< of the pair
  bool is_last = false;                                  ///< the limb beyond is one bone
  std::optional<Eigen::Vector3d> beside = std::nullopt;  ///< where its node is, if not at `at`
  int node = -1;                                         ///< its node, if it is known
  bool is_by_proportion = false;  ///< of a human whose limbs are hidden: it stays where it is
  std::optional<Eigen::Vector3d> end = std::nullopt;  ///< of its bone, where no joint says so
  std::optional<double> share = std::nullopt;  ///< of its way in the pose, if `at` is on its course
};

inline constexpr const char* shoulder_reason =
    "an arm's radius beyond the place where the curve leaves the trunk";
inline constexpr const char* elbow_reason = "half of the way from the shoulder to the wrist";
inline constexpr const char* wrist_reason =
    "the narrowest place about .68 of the way to the fingertips, before the fingers part";
[[nodiscard]] ArmJoints arm_joints(const CurveTree& tree, const LimbPair& arm);

/// Of the left hand, in VRM's words: a thumb and up to four more, where the curve has two or more
/// tips beyond the wrist. `pair` is the number of the arms.
[[nodiscard]] std::vector<Place> finger_places(const CurveTree& tree, const LimbPair& arm, int pair,
                                               const Eigen::Vector3d& wrist);

/// `posed` is the tree as it is where the other one is unposed, else nullptr.
[[nodiscard]] std::vector<Place> humanoid_places(const CurveTree& tree, const Limbs& limbs,
                                                 const PlanFound& found, const CurveTree* posed);
/// `found.legs` hind legs first.
[[nodiscard]] std::vector<Place> quadruped_places(const CurveTree& tree, const Limbs& limbs,
                                                  const PlanFound& found);
/// Birds, bipeds with tails.
[[nodiscard]] std::vector<Place> biped_places(const CurveTree& tree, const Limbs& limbs,
                                              const PlanFound& found);

/// True if a quadruped's head is at its rear: what is called front is its back. By the sum of how
/// much higher the front is, how much longer its ears and horns are, and how far toes reach ahead.
/// In a pose ears alone say so, where there are any: a tail may be lifted and a head lowered.
[[nodiscard]] bool looks_back(const CurveTree& tree, const Limbs& limbs, const PlanFound& found,
                              Standing standing);

/// True if the feet of a human reach farther behind the shins than ahead of them, by a twentieth of
/// the legs' length.
[[nodiscard]] bool toes_point_back(const CurveTree& tree, const Limbs& limbs,
                                   const PlanFound& found);

/// The same of a human whose legs are not images of each other, each of them as it lies: the feet
/// against their shins, or, if these are nearly in line, the knees, which bend ahead.
[[nodiscard]] bool legs_bend_back(const CurveTree& tree, const Limbs& limbs,
                                  const PlanFound& found);

/// True if the trunk is long, thick and level, with fins beside it.
[[nodiscard]] bool is_fish(const CurveTree& tree, const Limbs& limbs);
/// True if the thicker half of a fish's trunk is behind.
[[nodiscard]] bool swims_back(const CurveTree& tree, const Limbs& limbs);
[[nodiscard]] std::vector<Place> fish_places(const CurveTree& tree, const Limbs& limbs);

}  // namespace curveskel
