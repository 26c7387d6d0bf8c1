// Rigs in Python.
#pragma once

#include <pybind11/pybind11.h>

namespace curveskel {

/// Adds the class Rig and the function that makes one.
void bind_rig(pybind11::module_& module);

}  // namespace curveskel
