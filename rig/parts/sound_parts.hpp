// Parts that are of the vertices they are used with, checked where they enter.
#pragma once

#include <string_view>

#include <curveskel/rig_parts.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that begins with `purpose` unless each of so many vertices has one of
/// the parts. O(#V).
void require_parts_of(const RigParts& parts, Eigen::Index vertices, std::string_view purpose);

}  // namespace curveskel
