// A skeleton whose numbers are numbers of its own nodes, checked where it enters.
#pragma once

#include <string_view>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that begins with `purpose` unless edges and contacts are of nodes,
/// radii are as many as nodes or none, and no vertex has a node that there is not. O(#N + #E + #V).
void require_sound(const CurveSkeleton& skeleton, std::string_view purpose);

/// The same, and places are finite. O(#N + #E + #V).
void require_sound_places(const CurveSkeleton& skeleton, std::string_view purpose);

/// `edge_between` of neighbours on a branch. Throws Error(Fault::input) that begins with `purpose`
/// where no row is found, as in edges that are not sorted. O(log #E).
[[nodiscard]] int require_edge(const CurveSkeleton& skeleton, int a, int b,
                               std::string_view purpose);

/// As `require_sound`, unless node_of_vertex is by the surface's vertices, or empty. O(1).
void require_vertices_of(const CurveSkeleton& skeleton, const Surface& surface,
                         std::string_view purpose);

/// The same, and it must not be empty. O(1).
void require_map_of(const CurveSkeleton& skeleton, const Surface& surface,
                    std::string_view purpose);

/// Throws Error(Fault::input) that begins with `purpose` unless each of `numbers` is below `count`;
/// negative ones stand for none. O(numbers).
void require_below(const Eigen::VectorXi& numbers, Eigen::Index count, std::string_view purpose);

}  // namespace curveskel
