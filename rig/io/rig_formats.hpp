// The reader behind `read_rig`.
#pragma once

#include <optional>

#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// The work of `read_rig` once the file is in memory.
[[nodiscard]] std::optional<Rig> read_gltf_rig(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
