// Long work beside the interpreter: the GIL is free, progress and Ctrl-C come through.
#pragma once

#include <pybind11/pybind11.h>
#include <functional>

#include <curveskel/monitor.hpp>

namespace curveskel {

/// Runs `work` in a thread of its own. The calling thread, which has the GIL, lets go of it, looks
/// for signals ten times a second, and passes on the last progress: `progress(stage, fraction)`,
/// unless it is None. A signal (Ctrl-C) or an error of the callback stops the work, which takes
/// 0.1 s, and is raised. Errors of the work are thrown here.
void run_beside_interpreter(const pybind11::object& progress,
                            const std::function<void(const Monitor&)>& work);

}  // namespace curveskel
