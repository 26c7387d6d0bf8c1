// Files opened before, over several sessions.
#pragma once

#include <filesystem>
#include <vector>

namespace curveskel::viewer {

/// The newest first, at most ten, only those that are still there. Empty where there is no place to
/// keep them (XDG_STATE_HOME, or HOME).
[[nodiscard]] std::vector<std::filesystem::path> recent_files();
/// Puts `file` first. Does nothing where there is no place for it: this is a comfort, not a duty.
void remember_file(const std::filesystem::path& file);

}  // namespace curveskel::viewer
