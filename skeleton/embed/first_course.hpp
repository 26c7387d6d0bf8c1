// The graph as it is before any of its points has moved.
#pragma once

#include <optional>

#include "skeleton/embed/setting.hpp"
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

/// A SkeletonGraph of the partition, its points in the middle of the inscribed balls, without blunt
/// ends and inside the surface. Where straight lines between the partition's nodes, kept inside as
/// they are, lead a cycle off its handle, cycles go along the surface. Where the surface meets
/// itself, they may miss handles there, too, which no later step finds: then nothing if the setting
/// needs all handles.
[[nodiscard]] std::optional<SkeletonGraph> first_course(const Setting& in);

}  // namespace curveskel
