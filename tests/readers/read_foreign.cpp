// usage: read_foreign FOLDER: reads what other programs wrote there, foreign-NAME-*.*, and compares
// it with NAME.vtp, this program's own.
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include <curveskel/skeleton_files.hpp>
#include "tests/skeleton/skeleton_samples.hpp"

namespace {

/// Radii that another program writes in single precision are not expected here: all must be equal.
bool same(const curveskel::CurveSkeleton& a, const curveskel::CurveSkeleton& b) {
  return a.nodes.rows() == b.nodes.rows() && a.edges.rows() == b.edges.rows() &&
         a.radii.size() == b.radii.size() && a.nodes == b.nodes && a.edges == b.edges &&
         a.radii == b.radii;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace curveskel;
  if (count != 2) return 2;
  int read = 0;
  int failed = 0;
  std::map<std::string, CurveSkeleton> truth;
  for (const auto& [name, skeleton] : skeleton_samples()) truth[name] = skeleton;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with("foreign-")) continue;
    const std::size_t begin = std::string("foreign-").size();
    const std::string name = file.substr(begin, file.find('-', begin) - begin);
    ++read;
    try {
      if (same(read_skeleton(entry.path()), truth.at(name))) continue;
      std::printf("FAILED: %s differs\n", file.c_str());
    } catch (const std::exception& error) {
      std::printf("FAILED: %s\n", error.what());
    }
    ++failed;
  }
  std::printf("%d files read, %d failed\n", read, failed);
  if (read == 0) {
    std::printf("SKIPPED: no file written by another program\n");
    return 77;
  }
  return failed == 0 ? 0 : 1;
}
