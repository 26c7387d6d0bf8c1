#include "contraction/device/program_cache.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>

namespace curveskel::opencl {
namespace {

/// FNV-1a, in 16 hexadecimal digits: against accidents, not against malice.
std::string hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::array<char, 24> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

std::filesystem::path file_for(const std::filesystem::path& folder, std::string_view key) {
  return folder / (hash_of(key) + ".bin");
}

/// The file's bytes before the binary: drivers may crash on one that is not whole, so its length
/// and hash are there, too.
std::string head_of(const std::string& key, std::string_view binary) {
  std::string head = key;
  head += '\0';
  return head + std::to_string(binary.size()) + ' ' + hash_of(binary) + '\n';
}

std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

}  // namespace

std::vector<unsigned char> cached_binary(const std::filesystem::path& folder,
                                         const std::string& key) {
  if (folder.empty()) return {};
  const std::filesystem::path file = file_for(folder, key);
  const std::optional<std::string> content = content_of(file);
  if (!content) return {};
  const std::size_t line_end = content->find('\n', key.size());
  if (line_end != std::string::npos) {
    const std::string_view binary = std::string_view(*content).substr(line_end + 1);
    if (content->compare(0, line_end + 1, head_of(key, binary)) == 0) {
      return {binary.begin(), binary.end()};
    }
  }
  std::error_code failure;
  std::filesystem::remove(file, failure);
  return {};
}

void keep_binary(const std::filesystem::path& folder, const std::string& key,
                 const std::vector<unsigned char>& binary) {
  if (folder.empty() || binary.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  const std::string bytes(binary.begin(), binary.end());
  try {
    write_file(file_for(folder, key), head_of(key, bytes) + bytes);
  } catch (const Error&) {
    return;  // no cache
  }
}

}  // namespace curveskel::opencl
