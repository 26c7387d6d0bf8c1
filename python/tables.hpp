// Tables as dictionaries of columns, from which the package makes data frames.
#pragma once

#include <pybind11/pybind11.h>

#include "python/extraction.hpp"

namespace curveskel {

/// The columns of the CSV file but the first, which is the row's number. Areas and volumes need the
/// extraction; it may be null.
[[nodiscard]] pybind11::dict branch_table(const CurveSkeleton& skeleton,
                                          const PythonExtraction* extraction, int root);

/// The columns of `format_junctions`; branches and angles are lists.
[[nodiscard]] pybind11::dict junction_table(const CurveSkeleton& skeleton);

/// The columns of `format_profiles`. Long work: see `run_beside_interpreter`.
[[nodiscard]] pybind11::dict profile_table(const PythonExtraction& extraction, double spacing,
                                           int threads, const pybind11::object& listener);

}  // namespace curveskel
