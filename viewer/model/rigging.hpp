// The last entry of the timeline: joints and weights from the skeleton.
#pragma once

#include <memory>

#include <curveskel/make_rig.hpp>
#include <curveskel/repair.hpp>
#include "viewer/model/document.hpp"
#include "viewer/model/recording.hpp"

namespace curveskel::viewer {

/// The rig by the vertices of the document's file; node_of_vertex of the skeleton (if it has one)
/// is by these, too. Precondition: the document has a surface, `repaired` was made of it.
[[nodiscard]] std::shared_ptr<const Rig> rig_of(const Document& document,
                                                const RepairedSurface& repaired,
                                                const CurveSkeleton& skeleton,
                                                const RigOptions& options, const Monitor& monitor);

[[nodiscard]] Moment moment_of(std::shared_ptr<const Rig> rig);

}  // namespace curveskel::viewer
