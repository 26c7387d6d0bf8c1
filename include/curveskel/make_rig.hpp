// From a surface and its curve skeleton to a rig: joints, their hierarchy, skin weights.
#pragma once

#include <Eigen/Core>

#include <curveskel/advanced/joints.hpp>
#include <curveskel/advanced/skin_weights.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RigOptions {
  JointOptions joints;
  SkinOptions skin;
  bool faces_minus_z = false;  ///< the figure looks along -z: its left is where x is smaller
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const RigOptions& options);

/// `place_joints`, `skin_weights`, then `name_sides` (rig/sides.hpp). A vertex that has no node (or
/// none has) goes to the one whose ball is nearest. Precondition: a clean surface; node_of_vertex
/// by its vertices, if there is one. Throws Error(Fault::input) as `place_joints`, Cancelled on a
/// stop.
[[nodiscard]] Rig make_rig(const Surface& surface, const CurveSkeleton& skeleton,
                           const RigOptions& options = {}, const Monitor& monitor = {});

/// The skeleton with node_of_vertex, if it has one, by the vertices of the surface that was
/// repaired instead of those given; -1 for vertices that only the repair made. `vertex_of_input` is
/// as in RepairedSurface, `vertices` those of the surface.
/// Throws Error(Fault::input) where node_of_vertex is of another number of vertices.
[[nodiscard]] CurveSkeleton skeleton_of_repaired(CurveSkeleton skeleton,
                                                 const Eigen::VectorXi& vertex_of_input,
                                                 Eigen::Index vertices);

/// The rig of the surface as a rig of what it was repaired from: `vertex_of_input` and `given` are
/// as in RepairedSurface and PolygonSoup. Vertices that the repair left out (buttons, eyes, specks)
/// move with the nearest corner of the triangle that is nearest to them.
[[nodiscard]] Rig rig_of_given(const Rig& rig, const Surface& surface,
                               const Eigen::VectorXi& vertex_of_input, const Positions& given);

}  // namespace curveskel
