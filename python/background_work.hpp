// Long work beside the interpreter: the GIL is free, progress and Ctrl-C come through.
#pragma once

#include <pybind11/pybind11.h>
#include <functional>

#include <curveskel/monitor.hpp>

namespace curveskel {

/// Runs `work` in a thread of its own. The calling thread, which has the GIL, lets go of it and ten
/// times a second looks for signals and asks the listener, unless that is None:
/// `listener.look()`, which raises where the time is over, and with the last progress
/// `listener.tell(stage, fraction)`. A signal (Ctrl-C) or an error of the listener stops the work,
/// which takes 0.1 s, and is raised. Errors of the work are thrown here.
void run_beside_interpreter(const pybind11::object& listener,
                            const std::function<void(const Monitor&)>& work);

}  // namespace curveskel
