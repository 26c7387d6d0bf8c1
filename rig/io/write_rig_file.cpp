// A rig's file with the pictures beside it.
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include <curveskel/rig_files.hpp>
#include "base/utf8.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

/// Empty where there is none.
std::string bytes_in_file(const fs::path& file) {
  const std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (stream) content << stream.rdbuf();
  return std::move(content).str();
}

fs::path place_of_side(const fs::path& file, const SideFile& side) {
  return file.parent_path() / side.name;
}

/// As it is already.
bool is_written(const fs::path& place, const SideFile& side) {
  std::error_code none;
  return fs::is_regular_file(place, none) && fs::file_size(place, none) == side.bytes.size() &&
         bytes_in_file(place) == side.bytes;
}

/// Files and folders that were not there before go again, unless they are kept.
class NewPlaces {
 public:
  NewPlaces() = default;
  NewPlaces(const NewPlaces&) = delete;
  NewPlaces& operator=(const NewPlaces&) = delete;
  ~NewPlaces() {
    std::error_code none;
    for (; !made_.empty(); made_.pop_back()) fs::remove(made_.back(), none);
  }

  /// Before it is made, with the folders that it lies in.
  void add(const fs::path& place) {
    std::error_code none;
    if (place.empty() || fs::exists(fs::symlink_status(place, none))) return;
    add(place.parent_path());
    made_.push_back(place);
  }

  void keep() { made_.clear(); }

 private:
  std::vector<fs::path> made_;  // folders before what lies in them
};

}  // namespace

std::string picture_folder_of(const fs::path& output) {
  constexpr std::string_view not_taken = "/\\:*?\"<>|@";
  std::string name = as_utf8(output.stem().string());
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code == 127 || not_taken.find(c) != std::string_view::npos) c = '_';
  }
  return name + "_textures";
}

void require_free_places(const fs::path& file, const std::vector<SideFile>& side_files) {
  std::string replaced;
  bool is_read = false;
  for (const SideFile& side : side_files) {
    const fs::path place = place_of_side(file, side);
    std::error_code none;
    if (!fs::exists(place, none) || is_written(place, side)) continue;
    if (!is_read) replaced = bytes_in_file(file);
    is_read = true;
    if (replaced.find("@./" + side.name + "@") != std::string::npos) continue;
    throw Error(Fault::output, place.string() +
                                   ": is there, and is no picture of the file that is written; "
                                   "move it away or name another output");
  }
}

void write_rig_file(const fs::path& file, std::string_view bytes,
                    const std::vector<SideFile>& side_files) {
  require_free_places(file, side_files);
  NewPlaces made;
  for (const SideFile& side : side_files) {
    const fs::path place = place_of_side(file, side);
    if (is_written(place, side)) continue;
    made.add(place);
    std::error_code error;
    fs::create_directories(place.parent_path(), error);
    if (error) {
      throw Error(Fault::output, place.parent_path().string() + ": cannot be created (" +
                                     error.message() + "); name another output");
    }
    write_file(place, side.bytes);
  }
  write_file(file, bytes);
  made.keep();
}

}  // namespace curveskel
