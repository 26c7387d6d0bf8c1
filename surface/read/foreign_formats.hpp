// Files that are no surface which this program reads, by name. Internal to surface/.
#pragma once

#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Throws Error(Fault::input) that says what the file is, if its first bytes tell.
void refuse_foreign_format(const FileBytes& file);

}  // namespace curveskel
