// The viewer's window.
#pragma once

#include "app/verbs/verbs.hpp"
#include "viewer/view_options.hpp"

namespace curveskel::viewer {

/// Opens it and returns when a person has closed it; the exit code of the program.
/// Throws Error(Fault::device) where there is no display or no OpenGL 3.3.
[[nodiscard]] int run_window(const ViewOptions& options, Session& session);

}  // namespace curveskel::viewer
