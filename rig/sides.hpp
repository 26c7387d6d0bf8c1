// Left and right, where a rig has them.
#pragma once

#include "rig/rig.hpp"

namespace curveskel {

/// Limbs that are each other's mirror images, through a plane of the coordinate frame that holds
/// the first joint, get the same names and ".L" or ".R" behind them, as Blender and others expect
/// it to mirror poses and weights; a joint that only one of them has, too. Left is where x is
/// larger: a figure that faces you in its file's frame (z ahead in glTF, -y ahead in Blender) has
/// its left hand there. Of planes normal to y and z ".L" is where the coordinate is larger. The
/// plane with the most pairs is taken; of equals x, y, z. Limbs are matched as wholes, from the
/// root outwards: to within 6 % of the joints' diagonal in the mean, and hanging from a pair or
/// from one joint. Unique names stay so. O(limbs^2); nothing is done for more than 1,000 of them.
void name_sides(Rig& rig);

}  // namespace curveskel
