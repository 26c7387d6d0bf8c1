// The files of pictures, as far as the options want to see them.
#pragma once

#include <curveskel/monitor.hpp>
#include "viewer/model/document.hpp"
#include "viewer/view_options.hpp"

namespace curveskel::viewer {

/// `open_document`, but without the file's rig where a stage of the curve is wished for and nothing
/// of the rig. Throws UsageError for options that need a rig, or one with roles and parts, where
/// none is shown or made.
[[nodiscard]] Document open_for_pictures(const ViewOptions& options, const Monitor& monitor);

}  // namespace curveskel::viewer
