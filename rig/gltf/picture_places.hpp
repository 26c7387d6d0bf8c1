// The places of pictures that a file names.
#pragma once

#include <filesystem>
#include <string>

namespace curveskel {

/// A picture that `file` names, sought from `folder`: as it is named, and as paths of another
/// machine lead nowhere, beside it, in "textures", "Textures", "images", and in folders called as
/// the file, alone or with ".fbm". Where there is none: beside it. Separators may be those of any
/// system.
[[nodiscard]] std::filesystem::path picture_place(const std::filesystem::path& file,
                                                  const std::filesystem::path& folder,
                                                  std::string name);

}  // namespace curveskel
