// The comparison of two rigs for people.
#pragma once

#include <string>

#include <curveskel/compare_rigs.hpp>

namespace curveskel {

/// A table of a dozen lines, each with its line end.
[[nodiscard]] std::string rig_comparison_table(const RigComparison& comparison);

}  // namespace curveskel
