// Output of results: files by name, or standard output.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/verbs/verbs.hpp"

namespace curveskel {

/// A finished file that is not written yet.
struct OutputFile {
  std::string name;  ///< "-" for standard output
  std::string bytes;
  std::vector<SideFile> side_files = {};
};

/// The format that a file name's extension stands for. Throws UsageError listing the right ones.
template <typename Format, std::size_t Count>
[[nodiscard]] Format format_of(const std::string& name, const NameTable<Format, Count>& table) {
  const std::string extension = lower_extension(name);
  const auto found = choice_of(table, extension);
  if (found) return *found;
  throw UsageError(name + ": " +
                   (extension.empty() ? "has no extension, needed one of: "
                                      : "the extension ." + extension + " is none of: ") +
                   names_in(table));
}

/// The format of each output; `format` is that of "-". Throws UsageError where one is missing.
[[nodiscard]] std::vector<SkeletonFormat> formats_of(const std::vector<std::string>& names,
                                                     const std::optional<SkeletonFormat>& format);

/// Of a file that is written in one format alone: throws UsageError where its name does not end in
/// `extension` (without dot, in lower case), as a slip would overwrite another file. Nothing, "-"
/// and what is there but no regular file, such as a pipe, are let through. `option` is for the
/// message.
void require_extension(const std::string& name, std::string_view option,
                       std::string_view extension);

/// Before hours of work: throws UsageError where an output is named twice or is one of the inputs,
/// of which those not named are empty, and Error(Fault::output) where it is a folder itself, or its
/// folder does not exist.
void check_outputs(const std::vector<std::string>& names,
                   const std::vector<std::filesystem::path>& inputs);

/// Makes a folder for outputs, and those that it is in; one that exists will do. Throws
/// Error(Fault::output).
void make_folder(const std::filesystem::path& folder);

/// After a row of numbered files: warns where the folder has the next one, too, of a longer run
/// before this one.
void warn_of_older_files(const std::filesystem::path& folder, const std::string& next,
                         Session& session);

/// Writes each file whole, with its side files; an interruption takes effect between files, and
/// nothing is written where a side file is in the way.
void write_outputs(const std::vector<OutputFile>& files, Session& session);

}  // namespace curveskel
