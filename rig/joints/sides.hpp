// Left and right, where a rig has them.
#pragma once

#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Limbs that are each other's mirror images, through a plane of the coordinate frame, get the same
/// names and ".L" or ".R" behind them, as Blender and others expect it to mirror poses and weights;
/// a joint that only one of them has, too. Left is where x is larger: a figure that faces you in
/// its file's frame (z ahead in glTF, -y ahead in Blender) has its left hand there. Of planes
/// normal to y and z ".L" is where the coordinate is larger. `to_left`, of length 1, points to the
/// left hand of one that looks elsewhere: along -x if it looks along -z.
///
/// Limbs are matched as wholes, to within 6 % of the joints' diagonal in the mean, from the root
/// outwards: hanging from a pair or from one joint; then by way of limbs without an image; then, to
/// within 1.5 %, wherever they hang. Of the planes normal to an axis that is tried for which most
/// limbs are images, of the three axes' that with most length paired (and half of what lies in it),
/// of equals x, y, z. Where less than an eighth of all length is paired, nothing is named. Unique
/// names stay so. O(limbs^2 depth); nothing is done for more than 1,000 limbs.
void name_sides(Rig& rig, const Eigen::Vector3d& to_left = Eigen::Vector3d::UnitX());

/// By joint the one that is its mirror image by readable name, ".L" or ".R" instead of the other;
/// -1 = none. O(joints log joints).
[[nodiscard]] std::vector<int> twins_of(const Rig& rig);

}  // namespace curveskel
