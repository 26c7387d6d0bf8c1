#include "contraction/device/program_cache.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace curveskel::opencl {
namespace {

// FNV-1a; it only names the file, as the file holds the whole key.
std::string file_name(std::string_view key) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::array<char, 24> name{};
  std::snprintf(name.data(), name.size(), "%016llx.bin", static_cast<unsigned long long>(hash));
  return name.data();
}

}  // namespace

std::vector<unsigned char> cached_binary(const std::filesystem::path& folder,
                                         const std::string& key) {
  if (folder.empty()) return {};
  std::ifstream file(folder / file_name(key), std::ios::binary);
  if (!file) return {};
  std::vector<unsigned char> content{std::istreambuf_iterator<char>(file), {}};
  // Key, a zero, binary.
  if (content.size() <= key.size() + 1 || content[key.size()] != 0) return {};
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (content[i] != static_cast<unsigned char>(key[i])) return {};
  }
  content.erase(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(key.size() + 1));
  return content;
}

void keep_binary(const std::filesystem::path& folder, const std::string& key,
                 const std::vector<unsigned char>& binary) {
  if (folder.empty() || binary.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  const std::filesystem::path target = folder / file_name(key);
  // Two processes may write at once; each has its own file aside.
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  std::filesystem::path aside = target;
  aside += '.';
  aside += std::to_string(now);
  aside += ".part";
  {
    std::ofstream file(aside, std::ios::binary);
    file.write(key.data(), static_cast<std::streamsize>(key.size()));
    file.put('\0');
    for (const unsigned char byte : binary) file.put(static_cast<char>(byte));
    if (!file.flush()) {
      file.close();
      std::filesystem::remove(aside, failure);
      return;
    }
  }
  std::filesystem::rename(aside, target, failure);
  if (failure) std::filesystem::remove(aside, failure);
}

}  // namespace curveskel::opencl
