// A file's whole content in memory, unzipped, text in UTF-8; the start of every format's reader.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <curveskel/monitor.hpp>

namespace curveskel {

struct FileBytes {
  std::filesystem::path path;
  std::string content;  ///< unzipped; UTF-16 with its mark is made UTF-8

  /// Throws Error(Fault::input): "FILE: found FOUND, needed NEEDED; REMEDY".
  [[noreturn]] void fail(std::string_view found, std::string_view needed,
                         std::string_view remedy) const;
};

/// Reads in one go and unzips gzipped content (several gzip members in a row count as one file).
/// Throws Error(Fault::input) for a file that is missing, unreadable, a directory, empty or broken.
/// `needed` is for messages.
[[nodiscard]] FileBytes read_file(const std::filesystem::path& path, const Monitor& monitor,
                                  std::string_view needed = "a surface");

/// The same of content that is in memory.
[[nodiscard]] FileBytes unpacked(FileBytes file, const Monitor& monitor,
                                 std::string_view needed = "a surface");

/// At most 40 characters of the text in double quotes, unprintable ones escaped: for messages.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace curveskel
