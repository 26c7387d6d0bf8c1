// Arrays that are views of what a value holds.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

namespace curveskel {

/// A getter of a matrix: no copy, not writable. The value stays alive as long as the array.
template <typename Get>
pybind11::cpp_function view_of(const Get& get) {
  return pybind11::cpp_function(get, pybind11::return_value_policy::reference_internal);
}

}  // namespace curveskel
