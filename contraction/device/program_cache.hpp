// Compiled OpenCL programs on disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curveskel::opencl {

/// The binary kept in `folder` for exactly this key; empty when there is none that can be read. A
/// file that is damaged, or another key's, is removed.
[[nodiscard]] std::vector<unsigned char> cached_binary(const std::filesystem::path& folder,
                                                       const std::string& key);

/// Keeps a binary with its length and hash: the whole file or none of it, also when the machine
/// goes down meanwhile. Failing to is no error: the next run compiles again.
void keep_binary(const std::filesystem::path& folder, const std::string& key,
                 const std::vector<unsigned char>& binary);

}  // namespace curveskel::opencl
