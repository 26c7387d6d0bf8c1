#include "rig/gltf/picture_places.hpp"

#include <algorithm>
#include <system_error>

namespace curveskel {

std::filesystem::path picture_place(const std::filesystem::path& file,
                                    const std::filesystem::path& folder, std::string name) {
  namespace fs = std::filesystem;
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path alone = fs::path(name).filename();
  fs::path media = file.stem();
  media += ".fbm";
  for (const fs::path& path :
       {folder / name, folder / alone, folder / "textures" / alone, folder / "Textures" / alone,
        folder / "images" / alone, folder / file.stem() / alone, folder / media / alone}) {
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) return path;
  }
  return folder / alone;
}

}  // namespace curveskel
