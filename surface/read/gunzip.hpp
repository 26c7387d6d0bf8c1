// The content of gzipped files. Internal to surface/.
#pragma once

#include <string>

#include "surface/read/file_bytes.hpp"

namespace curveskel {

[[nodiscard]] bool is_gzipped(const std::string& content);

/// Unzips the content in place; several gzip members in a row count as one, what follows them is
/// ignored. Throws Error(Fault::input) for broken or truncated data.
void gunzip(FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
