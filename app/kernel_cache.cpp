#include "app/kernel_cache.hpp"

#include <cstdlib>

namespace curveskel {

std::filesystem::path kernel_cache() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache == '/') return std::filesystem::path(cache) / "curveskel";
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return std::filesystem::path(home) / ".cache" / "curveskel";
}

}  // namespace curveskel
