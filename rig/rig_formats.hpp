// The reader behind `read_rig`.
#pragma once

#include <optional>

#include "rig/rig.hpp"
#include "surface/file_bytes.hpp"
#include "surface/monitor.hpp"

namespace curveskel {

/// What `read_rig` does once the file is in memory.
[[nodiscard]] std::optional<Rig> read_gltf_rig(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
