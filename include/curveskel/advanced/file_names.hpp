// The parts of file names by which formats are told.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace curveskel {

/// The letters of ASCII; all others stay, whatever the locale.
[[nodiscard]] inline std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

/// "ply" of "Cow.PLY"; empty where there is none.
[[nodiscard]] inline std::string lower_extension(const std::filesystem::path& file) {
  const std::string extension = in_lower_case(file.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

/// "cow.ply" of "cow.ply.gz".
[[nodiscard]] inline std::filesystem::path without_gz(const std::filesystem::path& file) {
  return lower_extension(file) == "gz" ? file.parent_path() / file.stem() : file;
}

}  // namespace curveskel
