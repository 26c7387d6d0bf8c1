#include "surface/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <system_error>

namespace curveskel {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 22;

struct CloseZipped {
  void operator()(gzFile_s* file) const { gzclose_r(file); }
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

FileBytes read_file(const std::filesystem::path& path, const Monitor& monitor) {
  FileBytes file{path, {}};
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    file.fail("that it cannot be opened (" + system_message(errno) + ")", "a readable file",
              "check the name and the permissions");
  }
  struct stat status = {};
  const bool known = ::fstat(descriptor, &status) == 0;
  if (known && S_ISDIR(status.st_mode)) {
    ::close(descriptor);
    file.fail("a directory", "a surface file", "name a file in it");
  }
  // zlib hands through what is not gzipped, straight into our memory.
  const std::unique_ptr<gzFile_s, CloseZipped> zipped(gzdopen(descriptor, "rb"));
  if (!zipped) {
    ::close(descriptor);
    file.fail("no memory for zlib", "a few kilobytes", "close other programs");
  }

  const auto size = known && S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  std::size_t used = 0;
  file.content.resize(size + 1);  // one more, so that a plain file's end shows without growing
  for (;;) {
    if (used == file.content.size()) file.content.resize(2 * used);
    const std::size_t wanted = std::min(chunk_bytes, file.content.size() - used);
    const int got = gzread(zipped.get(), file.content.data() + used, static_cast<unsigned>(wanted));
    if (got < 0) {
      int code = Z_OK;
      const std::string reason = gzerror(zipped.get(), &code);
      file.fail("that reading breaks off after " + std::to_string(used) + " bytes (" +
                    (code == Z_ERRNO ? system_message(errno) : reason) + ")",
                "an intact file", "fetch or pack it again");
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    monitor.report("read", 0);
  }
  int code = Z_OK;
  gzerror(zipped.get(), &code);
  if (code == Z_BUF_ERROR) {
    file.fail("the end of the gzipped data after " + std::to_string(used) + " unzipped bytes",
              "a complete gzip file", "it is truncated: fetch or pack it again");
  }
  file.content.resize(used);
  if (used == 0) file.fail("0 bytes", "a surface", "export or fetch the file again");
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
