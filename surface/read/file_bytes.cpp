#include "surface/read/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include "base/memory.hpp"
#include "surface/read/gunzip.hpp"
#include "surface/read/utf16.hpp"

namespace curveskel {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 22;

class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

 private:
  int descriptor_;
};

std::string system_message(int error) { return std::generic_category().message(error); }

}  // namespace

void FileBytes::fail(std::string_view found, std::string_view needed,
                     std::string_view remedy) const {
  std::string message = path.string();
  message.append(": found ").append(found).append(", needed ").append(needed);
  message.append("; ").append(remedy);
  throw Error(Fault::input, message);
}

FileBytes read_file(const std::filesystem::path& path, const Monitor& monitor,
                    std::string_view needed) {
  FileBytes file{path, {}};
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    file.fail("that it cannot be opened (" + system_message(errno) + ")", "a readable file",
              "check the name and the permissions");
  }
  const OpenFile open(descriptor);
  struct stat status = {};
  const bool known = ::fstat(descriptor, &status) == 0;
  if (known && S_ISDIR(status.st_mode)) {
    file.fail("a directory", "a file with " + std::string(needed), "name a file in it");
  }
  const auto size = known && S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  std::size_t used = 0;
  require_memory(2 * static_cast<double>(size), available_memory_bytes(), path.string(),
                 Fault::input, "decimate it on a larger machine first");
  file.content.resize(size + 1);  // one more, so that the end shows without growing
  for (;;) {
    if (used == file.content.size()) file.content.resize(2 * used);
    const std::size_t wanted = std::min(chunk_bytes, file.content.size() - used);
    const auto got = ::read(descriptor, file.content.data() + used, wanted);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      file.fail("that reading breaks off after " + std::to_string(used) + " bytes (" +
                    system_message(errno) + ")",
                "an intact file", "fetch it again");
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    monitor.report("read", 0);
  }
  file.content.resize(used);
  return unpacked(std::move(file), monitor, needed);
}

FileBytes unpacked(FileBytes file, const Monitor& monitor, std::string_view needed) {
  if (is_gzipped(file.content)) gunzip(file, monitor);
  if (is_utf16(file.content)) utf16_to_utf8(file);
  if (file.content.empty()) file.fail("0 bytes", needed, "export or fetch the file again");
  return file;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  constexpr std::array<char, 17> digits{"0123456789abcdef"};
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20 || byte >= 0x7f) {
      result += "\\x";
      result += digits[byte >> 4U];
      result += digits[byte & 15U];
    } else {
      result += c;
    }
  }
  if (text.size() > longest) result += "...";
  return result + '"';
}

}  // namespace curveskel
