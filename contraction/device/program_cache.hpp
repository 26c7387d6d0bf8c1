// Compiled OpenCL programs on disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curveskel::opencl {

/// The binary kept in `folder` for exactly this key; empty when there is none that can be read.
[[nodiscard]] std::vector<unsigned char> cached_binary(const std::filesystem::path& folder,
                                                       const std::string& key);

/// Keeps a binary, written aside and renamed so that no reader sees half of one. Failing to is no
/// error: the next run compiles again.
void keep_binary(const std::filesystem::path& folder, const std::string& key,
                 const std::vector<unsigned char>& binary);

}  // namespace curveskel::opencl
