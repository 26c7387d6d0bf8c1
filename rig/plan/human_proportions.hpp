// The places of a standing human's joints: means over artists' rigs, docs/study/rig.md.
#pragma once

namespace curveskel {

// Of the body's height.
constexpr double shoulders_of_height = 0.79;
constexpr double chin_of_height = 0.875;
constexpr double waist_of_height = 0.65;
// Of the shoulders' height, which says more of the rest: heads and hats differ most.
constexpr double hips_of_shoulders = 0.648;
constexpr double hip_aside = 0.07;
constexpr double shoulder_aside = 0.11;
constexpr double arm_reach = 0.53;
constexpr double arm_radius = 0.04;
constexpr double foot_reach = 0.157;  // ahead of the ankle
constexpr double knee_ahead = 0.015;  // of the hip
constexpr double ankle_behind = 0.018;
// Of the hips' height.
constexpr double knee_of_hips = 0.56;
constexpr double ankle_of_hips = 0.115;
// Of the neck's.
constexpr double shoulders_of_neck = 0.92;
// Of the arm's reach.
constexpr double wrist_of_reach = 0.68;
constexpr double hanging_slope = 0.18;  // outwards, 10 degrees at most

}  // namespace curveskel
