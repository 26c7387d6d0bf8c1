#include "app/verbs/viewer_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include <curveskel/skeleton_files.hpp>
#include <curveskel/write_file.hpp>
#include <curveskel/write_surface.hpp>

namespace curveskel {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "curveskel-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw Error(Fault::output, name + ": cannot be created (" + std::strerror(errno) +
                                     "); set TMPDIR to a folder that can be written to");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// Starts it with nothing to read, and what it says in `log`. 0 = it could not be started.
pid_t start(std::vector<std::string> words, const fs::path& log) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t process = 0;
  const int failed =
      posix_spawn(&process, words[0].c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? process : 0;
}

/// Its exit status, or -1 where a signal ended it.
int wait_for(pid_t process, const Interruption& interruption) {
  int status = 0;
  try {
    while (waitpid(process, &status, WNOHANG) == 0) {
      interruption.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  } catch (...) {
    kill(process, SIGTERM);
    waitpid(process, &status, 0);
    throw;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const auto end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

}  // namespace

fs::path viewer_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path() / "curveskel-view";
}

ViewerPicture picture_by_viewer(const Surface& surface, const CurveSkeleton& skeleton,
                                const Interruption& interruption) {
  const TemporaryFolder folder;
  write_file(folder / "surface.ply", format_surface(surface, SurfaceFormat::ply));
  write_file(folder / "skeleton.ply", format_skeleton(skeleton, SkeletonFormat::ply, {}));
  const pid_t process = start({viewer_program().string(), (folder / "surface.ply").string(),
                               (folder / "skeleton.ply").string(), "--two-sides", "--size",
                               "1600x1200", "--screenshot", (folder / "picture.png").string()},
                              folder / "log");
  if (process == 0) return {{}, "it cannot be started"};
  if (wait_for(process, interruption) != 0) return {{}, last_line(content_of(folder / "log"))};
  return {content_of(folder / "picture.png"), {}};
}

}  // namespace curveskel
