// Joints that lie in the body.
#pragma once

#include <curveskel/advanced/joints.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A joint outside of the surface goes to the nearest of its own nodes, or of its parent's: the
/// mean of two sides, or a share of a bent limb, may lie beside both. Of several pieces, such as a
/// doll's, all stay: its joints are in the gaps. O(#F log #F + joints * nodes).
/// Precondition: a closed surface.
void draw_inside(Joints& joints, const Surface& surface, const CurveSkeleton& skeleton,
                 int threads);

}  // namespace curveskel
