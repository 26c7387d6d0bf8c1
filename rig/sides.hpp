// Left and right, where a rig has them.
#pragma once

#include "rig/rig.hpp"

namespace curveskel {

/// Where most joints have a mirror image, through a plane of the coordinate frame that holds the
/// root, gives both of each pair the same name and ".L" or ".R", as Blender and others expect it to
/// mirror poses and weights. Left is where x is larger: a figure that faces you in its file's frame
/// (z ahead in glTF, -y ahead in Blender) has its left hand there. Of planes normal to y and z,
/// too,
/// ".L" is where the coordinate is larger. The plane with the most pairs is taken; of equals x, y,
/// z. Pairs are within 3 % of the joints' diagonal, and hang from a pair or from one joint.
/// Unique names stay so. O(j^2); nothing is done for more than 4,000 joints.
void name_sides(Rig& rig);

}  // namespace curveskel
