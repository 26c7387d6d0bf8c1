// Which components of a surface have a component of the skeleton to themselves.
#pragma once

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The components of the surface that are left without a curve when as many as possible have one of
/// the skeleton's components each, of those with a node inside. So a curve where components overlap
/// or lie in each other counts for the one that needs it; how much of it is inside is another
/// figure's to say. O(#F log #F), and
/// queries for 64 nodes of each component in whose box a component of the skeleton lies.
[[nodiscard]] int components_without_curve(const Surface& surface, const CurveSkeleton& skeleton);

}  // namespace curveskel
