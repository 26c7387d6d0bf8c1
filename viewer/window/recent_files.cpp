#include "viewer/window/recent_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;

fs::path place() {
  const char* const state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state != '\0') return fs::path(state) / "curveskel" / "recent-files";
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return {};
  return fs::path(home) / ".local" / "state" / "curveskel" / "recent-files";
}

std::vector<fs::path> remembered() {
  std::vector<fs::path> files;
  std::ifstream in(place());
  for (std::string line; std::getline(in, line);) files.emplace_back(line);
  return files;
}

}  // namespace

std::vector<fs::path> recent_files() {
  std::vector<fs::path> files = remembered();
  std::erase_if(files, [](const fs::path& file) {
    std::error_code error;
    return !fs::exists(file, error);
  });
  return files;
}

void remember_file(const fs::path& file) {
  if (place().empty()) return;
  constexpr std::size_t most = 10;
  std::error_code error;
  const fs::path whole = fs::absolute(file, error);
  std::vector<fs::path> files = remembered();
  std::erase(files, whole);
  files.insert(files.begin(), whole);
  if (files.size() > most) files.resize(most);
  std::string text;
  for (const fs::path& one : files) text += one.string() + "\n";
  fs::create_directories(place().parent_path(), error);
  try {
    write_file(place(), text);
  } catch (const Error&) {
    return;  // a read-only home is no reason to complain
  }
}

}  // namespace curveskel::viewer
