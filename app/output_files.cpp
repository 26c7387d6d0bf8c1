#include "app/output_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include <curveskel/error.hpp>

namespace curveskel {

namespace fs = std::filesystem;

std::vector<SkeletonFormat> formats_of(const std::vector<std::string>& names,
                                       const std::optional<SkeletonFormat>& format) {
  std::vector<SkeletonFormat> formats;
  bool used = false;
  for (const std::string& name : names) {
    if (name != "-") {
      formats.push_back(format_of(name, skeleton_formats));
      continue;
    }
    if (!format) {
      throw UsageError("-o - needs --format NAME, one of: " + names_in(skeleton_formats));
    }
    formats.push_back(*format);
    used = true;
  }
  if (format && !used) {
    throw UsageError("--format is for -o -; a file's format follows from its extension");
  }
  return formats;
}

void require_extension(const std::string& name, std::string_view option,
                       std::string_view extension) {
  if (name.empty() || name == "-" || lower_extension(name) == extension) return;
  std::error_code none;
  const fs::file_status status = fs::status(name, none);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  throw UsageError(fmt::format("{}: {} writes {}, needed a name that ends in .{}", name, option,
                               extension, extension));
}

void check_outputs(const std::vector<std::string>& names, const std::vector<fs::path>& inputs) {
  std::set<fs::path> seen;
  for (const std::string& name : names) {
    std::error_code none;
    if (!seen.insert(name == "-" ? fs::path(name) : fs::weakly_canonical(fs::absolute(name), none))
             .second) {
      throw UsageError(name + " is named twice as an output");
    }
    if (name == "-") continue;
    const auto is_it = [&](const fs::path& input) { return fs::equivalent(name, input, none); };
    if (std::any_of(inputs.begin(), inputs.end(), is_it)) {
      throw UsageError(name + (inputs.size() == 1 ? " is the input" : " is an input") +
                       "; name another output");
    }
    if (fs::is_directory(name, none)) {
      throw Error(Fault::output, name +
                                     ": is a folder, needed the name of a file; name another "
                                     "output, or a file in it");
    }
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, none)) {
      throw Error(Fault::output,
                  fmt::format("{}: there is no folder {}; create it first", name, folder.string()));
    }
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw Error(Fault::output, folder.string() + ": cannot be created (" + error.message() +
                                   "); name another folder");
  }
}

void warn_of_older_files(const fs::path& folder, const std::string& next, Session& session) {
  if (!fs::exists(folder / next)) return;
  session.terminal.warn(fmt::format(
      "{}: {} and those after it are of an earlier run; remove them, or name another folder",
      folder.string(), next));
}

void write_outputs(const std::vector<OutputFile>& files, Session& session) {
  for (const OutputFile& file : files) require_free_places(file.name, file.side_files);
  for (const OutputFile& file : files) {
    session.interruption.check();
    if (file.name == "-") {
      session.terminal.end_progress();
      Terminal::write_output(file.bytes);
      session.interruption.count_written();
      continue;
    }
    const auto hold = session.interruption.hold();
    write_rig_file(file.name, file.bytes, file.side_files);
    session.interruption.count_written();
  }
}

}  // namespace curveskel
