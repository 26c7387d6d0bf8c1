// Files out: the whole file or none of it.
#pragma once

#include <filesystem>
#include <string_view>

namespace curveskel {

/// Replaces `file` by these bytes. They go to a temporary file beside it, which is renamed once all
/// of them are on the disk: at no time does `file` hold a part of them, and a failure leaves what
/// was there before. Permissions of a file that is replaced stay, symbolic links are followed, and
/// what is no regular file (a pipe, /dev/null) is written to directly.
/// Throws Error(Fault::output) with the system's reason: no permission, no such folder, a
/// directory, disk full. O(bytes).
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace curveskel
