// The folder where compiled OpenCL kernels are kept between runs.
#pragma once

#include <filesystem>

namespace curveskel {

/// A folder of the user's (XDG base directories); empty, for none, without a home.
[[nodiscard]] std::filesystem::path kernel_cache();

}  // namespace curveskel
