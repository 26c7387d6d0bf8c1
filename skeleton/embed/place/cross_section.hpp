// The middle of a limb, seen from a point in the limb.
#pragma once

#include <functional>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// The centre of the cross-section through `point` normal to `direction`: twice the mean of the
/// vectors along rays to the surface, which is exact to first order for a circle. 12 rays, each cut
/// at three times the point's inscribed `radius`. The point itself if that is not positive.
[[nodiscard]] Point cross_section_centre(const SurfaceTree& tree, const Point& point,
                                         const Point& direction, double radius,
                                         const SectionTuning& tuning = {});

struct CrossSection {
  Point centre;
  double width = 0;  ///< mean length of the rays: the radius of a round limb
};

/// The same where a limb is flat, from one edge of it to the other: of two opposite rays none is
/// cut where both end on a triangle that `is_own`. The parts of rays that are cut off lie in other
/// limbs. The centre no farther from the point than half the width, as far rays may differ from
/// one point to the next.
[[nodiscard]] CrossSection flat_cross_section(const SurfaceTree& tree, const Point& point,
                                              const Point& direction, double radius,
                                              const std::function<bool(int)>& is_own,
                                              const SectionTuning& tuning = {});

}  // namespace curveskel
