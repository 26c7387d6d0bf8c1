#include <curveskel/advanced/write_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

namespace fs = std::filesystem;

std::string remedy_for(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "create the folder first or name another";
    case EACCES:
    case EPERM:
    case EROFS:
      return "change the permissions or write elsewhere";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or write elsewhere";
    case EISDIR:
      return "name a file in it";
    default:
      return "write elsewhere";
  }
}

[[noreturn]] void fail(const fs::path& file, int error) {
  throw Error(Fault::output, file.string() + ": cannot be written (" +
                                 std::generic_category().message(error) + "); " +
                                 remedy_for(error));
}

/// An open file that is closed, and as long as it has a name to remove, removed.
class Output {
 public:
  explicit Output(int descriptor, fs::path unfinished = {})
      : descriptor_(descriptor), unfinished_(std::move(unfinished)) {}
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!unfinished_.empty()) ::unlink(unfinished_.c_str());
  }

  /// The system's error, or 0.
  int write(std::string_view bytes) const {
    constexpr std::size_t piece_bytes = std::size_t{1} << 26;
    while (!bytes.empty()) {
      const auto written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), piece_bytes));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
  }
  /// Some file systems report a full disk only when they are asked to flush or to close.
  int finish(bool flush) {
    if (flush && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) return errno;
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0 ? 0 : errno;
  }
  int rename_to(const fs::path& file) {
    if (::rename(unfinished_.c_str(), file.c_str()) != 0) return errno;
    unfinished_.clear();
    return 0;
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  fs::path unfinished_;
};

void write_in_place(const fs::path& file, std::string_view bytes) {
  Output output(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  if (output.descriptor() < 0) fail(file, errno);
  if (const int error = output.write(bytes)) fail(file, error);
  if (const int error = output.finish(false)) fail(file, error);
}

/// A new file beside `file`; the name that was free.
int create_beside(const fs::path& file, fs::path& name) {
  constexpr std::size_t most = 200;  // of the name's bytes: file systems allow 255 in all
  const std::string stem =
      std::string(".").append(file.filename().string().substr(0, most)).append(".part");
  for (int attempt = 0;; ++attempt) {
    name = file.parent_path() / (stem + std::to_string(::getpid()) + "-" + std::to_string(attempt));
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST) return -1;
  }
}

/// The end of a chain of symbolic links, the last name existing or not.
fs::path target_of(fs::path file) {
  constexpr int most_links = 40;  // as many as the kernel follows
  std::error_code none;
  for (int links = 0; links < most_links && fs::is_symlink(file, none); ++links) {
    file = file.parent_path() / fs::read_symlink(file, none);
  }
  return file;
}

}  // namespace

void write_file(const fs::path& file, std::string_view bytes) {
  if (file.empty()) fail("\"\"", ENOENT);
  struct stat old = {};
  const bool exists = ::stat(file.c_str(), &old) == 0;
  if ((exists && S_ISDIR(old.st_mode)) || file.filename().empty()) fail(file, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) return write_in_place(file, bytes);
  if (exists && ::access(file.c_str(), W_OK) != 0) fail(file, errno);

  const fs::path target = target_of(file);
  fs::path part;
  const int descriptor = create_beside(target, part);
  if (descriptor < 0) fail(file, errno);
  Output output(descriptor, part);
  if (exists && ::fchmod(descriptor, old.st_mode & 07777U) != 0) fail(file, errno);
  if (const int error = output.write(bytes)) fail(file, error);
  if (const int error = output.finish(true)) fail(file, error);
  if (const int error = output.rename_to(target)) fail(file, error);
}

}  // namespace curveskel
